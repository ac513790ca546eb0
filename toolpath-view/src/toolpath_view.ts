/** A path in three dimensions, in a container that somebody else lays out. It knows no page around it: whoever has a
 * Toolpath and an element can show one. */
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { number, palettes, stepColors, type Color, type Mode, type Theme } from './colors';
import { listenForClicks, type Click } from './clicks';
import type { Mark } from './comparison';
import { hiddenSteps, noFilter, type Filter } from './filter';
import { frames, grid, HeadModel, stock, ToolModel, travel, type Box } from './furniture';
import { MeasureModel } from './measure_model';
import { arcCenter, type Snap } from './measuring';
import { OtherPath } from './other_path';
import { PathLines } from './path_lines';
import { codeOf, type Role } from './scene';
import { SceneModel } from './scene_model';
import type { StockMode } from './stock_colors';
import { StockModel } from './stock_model';
import type { Section, StockHit } from './stock_ray';
import { stlOf } from './stock_stl';
import { StockTimeline } from './stock_timeline';
import { Kind, type Steps, type Toolpath, type Vector } from './toolpath';

export type Look = 'iso' | 'top' | 'front' | 'side';
export type Layer = 'path' | 'rapids' | 'frames' | 'travel' | 'tool' | 'head' | 'stock' | 'grid' | 'ahead' | 'fixtures' | 'spoilboard' | 'target' | 'machine';

/** The layers of bodies that surround the program. */
export const layerOf: Record<Role, Layer> = {
  fixture: 'fixtures',
  spoilboard: 'spoilboard',
  target: 'target',
  stock: 'stock',
  machine: 'machine',
};

/** From where one looks. From above a little from the front, so that Y goes up. */
const looks: Record<Look, Vector> = { iso: [-1, -1, 0.816], top: [0, -1e-5, 1], front: [0, -1, 0], side: [1, 0, 0] };

const near = 9; // Pixels within which a click hits a line.
const nearSnap = 12; // Pixels within which a measurement finds the end of a move or the corner of a body.
const frameSize = 44; // Pixels.
const edge = 24; // Pixels: nearer to the border of the picture, what is marked is out of sight.
const smallestView = 5; // Millimeters that a part of the path is shown with at least.
const nearView = 260; // Millimeters that a near view is high.
const nothing: Steps = { start: -1, end: -1 };

export interface Hit {
  point: number;
  part: number;
}

/** Another path to draw, and what has become of each step of both. */
export interface ComparedPath {
  path: Toolpath;
  markOf: (step: number) => Mark;
  ownMarkOf: (step: number) => Mark;
}

/** The nearest line of a path, and what it is as near as. */
type NearHit = Hit & { distance: number; depth: number };

export class ToolpathView {
  /** Somebody clicked the path, or beside it. */
  onPick: (hit: Hit | null) => void = () => {};
  /** Somebody clicked the path that this one is compared with. */
  onPickOther: (hit: Hit) => void = () => {};
  /** Somebody clicked the mark of a contact. */
  onContact: (contact: number) => void = () => {};
  /** Somebody clicked the stock, where this line has cut it. */
  onCut: (line: number) => void = () => {};
  /** While it measures: a place has been clicked; null is none. */
  onSnap: (snap: Snap | null) => void = () => {};
  /** While it measures: the pointer is at a place; null is none. */
  onHover: (snap: Snap | null) => void = () => {};

  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly world = new THREE.Group();
  private readonly camera = new THREE.OrthographicCamera();
  private readonly controls: OrbitControls;
  private readonly center: THREE.Vector3;
  private size: number;
  private lines: PathLines;
  private readonly tool = new ToolModel();
  private readonly head = new HeadModel();
  private readonly tip: THREE.Sprite;
  private readonly resizing: ResizeObserver;
  private frames = new THREE.Group();
  private travel: THREE.LineSegments | null = null;
  private grid: THREE.LineSegments | null = null;
  private stock: THREE.LineSegments | null = null;
  /** Corners that somebody knows; else it is around what is cut. */
  private stockKnown: Box | null = null;
  /** The stock that is cut, where it has been recorded. */
  private cutStock: StockModel | null = null;
  private stockMode: StockMode = 'tool';
  private section: Section | null = null;
  private surroundings: SceneModel | null = null;
  private readonly measure = new MeasureModel();
  private isMeasuring = false;
  private filter: Filter = noFilter;
  private hidden: Uint8Array | null = null;
  /** Of arcs, when somebody has asked. */
  private centers: Snap[] | null = null;
  private lit: PathLines | null = null;
  private litSteps: Steps = nothing;
  private selected: Steps | null = null;
  private other: OtherPath | null = null;
  private isMarked = false;
  private markOf: (step: number) => Mark = () => 'same';
  private otherTime = 0;
  /** How much of both paths is seen: 0 is the other one alone, 1 this one alone. */
  private blended = 0.5;
  private mode: Mode = 'tool';
  private readonly shown: Record<Layer, boolean>;
  private background: Color;
  private time = 0;
  /** How far bodies reach beyond the path, mm. */
  private extent = 0;
  /** The lower end of what the setup puts into the machine, on which the grid lies; mm. */
  private floor = Infinity;
  /** Where the pointer was last, while somebody measures. */
  private hovered: { x: number; y: number } | null = null;
  /** Pixels at the right that something else covers. */
  private covered = 0;
  /** Whether the scene has the tool that is shown. */
  private isToolKnown = false;
  private toolLength = 0;
  private isDue = false;
  private isDisposed = false;

  /** Throws where there is no WebGL 2. */
  constructor(
    private readonly container: HTMLElement,
    private path: Toolpath,
    private theme: Theme,
    shown: Record<Layer, boolean>,
  ) {
    this.shown = { ...shown };
    this.background = palettes[theme].background;
    this.renderer = new THREE.WebGLRenderer({ antialias: true });
    this.renderer.localClippingEnabled = true;
    const canvas = this.renderer.domElement;
    container.append(canvas);
    this.center = new THREE.Vector3(...path.min).add(new THREE.Vector3(...path.max)).multiplyScalar(0.5);
    this.size = sizeOf(path);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.invalidate());
    this.world.position.copy(this.center).negate();
    this.lines = new PathLines(path, this.center);
    this.lines.mesh.renderOrder = 1;
    this.tip = new THREE.Sprite(new THREE.SpriteMaterial({ map: dot(), depthTest: false, sizeAttenuation: false }));
    this.tip.renderOrder = 4;
    this.world.add(this.tool.object, this.head.object, this.tip, this.measure.object);
    this.surround();
    this.placeCutStock();
    const sky = new THREE.HemisphereLight(0xffffff, 0x777788, 2.2);
    sky.position.set(0, 0, 1);
    const sun = new THREE.DirectionalLight(0xffffff, 1.6);
    sun.position.set(-0.6, -1, 1.4);
    this.scene.add(this.world, this.lines.mesh, sky, sun);
    this.setTheme(theme);
    listenForClicks(canvas, (click) => this.onClick(click));
    canvas.addEventListener('pointermove', (event) => {
      if (!this.isMeasuring || event.buttons !== 0) return;
      const box = canvas.getBoundingClientRect();
      this.hover(event.clientX - box.left, event.clientY - box.top);
    });
    this.resizing = new ResizeObserver(() => {
      // A canvas is empty once it has another size.
      if (this.resize()) this.draw();
    });
    this.resize();
    this.resizing.observe(container);
    this.look('iso');
    this.setTime(0);
  }

  get canvas(): HTMLCanvasElement {
    return this.renderer.domElement;
  }

  setTheme(theme: Theme, background = palettes[theme].background): void {
    this.theme = theme;
    this.background = background;
    this.scene.background = new THREE.Color(number(background));
    this.tip.material.color.setHex(number(palettes[theme].highlight));
    this.measure.setTheme(theme);
    this.surroundings?.setTheme(theme);
    this.cutStock?.setTheme(theme);
    this.furnish();
    this.paint();
    this.litSteps = nothing;
    this.setTime(this.time);
    this.setOtherTime(this.otherTime);
    this.resizeLines();
  }

  /** Shows another path, as after an edit. One looks at it as before, or at all of it where there was none to look at. */
  take(path: Toolpath): void {
    const wasEmpty = this.path.work === null;
    const size = sizeOf(path);
    this.path = path;
    this.camera.zoom *= size / this.size;
    this.size = size;
    this.scene.remove(this.lines.mesh);
    this.lines.dispose();
    this.lines = new PathLines(path, this.center);
    this.lines.mesh.renderOrder = 1;
    this.lines.mesh.visible = this.shown.path;
    this.scene.add(this.lines.mesh);
    this.centers = null;
    this.surround();
    this.placeCutStock();
    this.keep(this.filter);
    this.selected = null;
    this.time = Math.min(this.time, path.seconds);
    this.frameCamera();
    this.setTheme(this.theme, this.background);
    if (wasEmpty) this.fit();
  }

  /** Steps that are lit up in place of the one at the time shown; null is none. Marked, they have the colors of what has become of them. */
  select(steps: Steps | null, isMarked = false): void {
    this.selected = steps;
    if (isMarked !== this.isMarked) this.litSteps = nothing;
    this.isMarked = isMarked;
    this.setTime(this.time);
  }

  /** Draws the path of another program, too; null takes it away. */
  compare(other: ComparedPath | null): void {
    this.other?.dispose();
    if (this.other) this.world.remove(this.other.tool.object);
    this.other = other && new OtherPath(other.path, other.markOf, this.scene, this.center);
    this.markOf = other?.ownMarkOf ?? (() => 'same');
    if (this.other) {
      this.world.add(this.other.tool.object);
      for (const corner of [this.other.path.min, this.other.path.max])
        this.extent = Math.max(this.extent, 2 * new THREE.Vector3(...corner).distanceTo(this.center));
    }
    this.paint();
    this.resizeLines();
    this.frameCamera();
    this.setOtherTime(this.otherTime);
    this.blend(this.blended);
  }

  /** How much of both paths is seen: 0 is the other one alone, 0.5 both, 1 this one alone. */
  blend(part: number): void {
    this.blended = part;
    this.resizeLines();
    this.setTime(this.time);
  }

  /** Moves the tool of the other path to where it is then. */
  setOtherTime(time: number): void {
    this.otherTime = time;
    this.other?.setTime(time, this.size);
    this.invalidate();
  }

  /** Steps of the other path that are lit up; null is none. */
  selectOther(steps: Steps | null, isMarked = false): void {
    this.other?.light(steps, isMarked);
    this.resizeLines();
    this.invalidate();
  }

  /** The stock's corners; null where they are unknown. */
  setStock(box: Box | null): void {
    this.stockKnown = box;
    this.furnish();
    this.invalidate();
  }

  colorBy(mode: Mode): void {
    this.mode = mode;
    this.paint();
    this.invalidate();
  }

  colorStockBy(mode: StockMode): void {
    this.stockMode = mode;
    this.cutStock?.colorBy(mode);
    this.invalidate();
  }

  /** Leaves out what of the stock is on one side of a plane; null leaves out nothing. */
  cutOff(section: Section | null): void {
    this.section = section;
    this.cutStock?.cutOff(section);
    this.invalidate();
  }

  /** The side of an axis on which one stands: what is there hides what is behind. */
  sideOf(axis: 0 | 1 | 2): 1 | -1 {
    return this.camera.position.clone().sub(this.controls.target).getComponent(axis) < 0 ? -1 : 1;
  }

  /** The stock at the moment as a binary STL file, in parts; null where there is none. */
  stl(): Uint8Array<ArrayBuffer>[] | null {
    return this.cutStock && stlOf(this.cutStock.timeline.dexels, this.cutStock.facts);
  }

  /** What is seen, as a PNG file. */
  async picture(): Promise<Blob | null> {
    do this.draw();
    while (this.cutStock && this.shown.stock && this.cutStock.lastUpdate.isMore);
    // The canvas is empty once this task is over.
    return new Promise((done) => this.canvas.toBlob(done, 'image/png'));
  }

  /** Whether the scene has bodies of a role. */
  hasBodies(role: Role): boolean {
    return this.surroundings?.hasRole(role) ?? false;
  }

  /** For tests, which look from outside. */
  get stockModel(): StockModel | null {
    return this.cutStock;
  }

  /** Whether there is a stock to show: one that is cut, or a body of the scene. */
  get hasStock(): boolean {
    return this.cutStock !== null || this.hasBodies('stock');
  }

  /** Whether the scene has the spindle, so that no head of a common size is drawn. */
  get hasSpindle(): boolean {
    return this.surroundings?.hasSpindle ?? false;
  }

  /** Shows a part of the path. */
  keep(filter: Filter): void {
    this.filter = filter;
    this.hidden = hiddenSteps(this.path, filter);
    this.lines.keepHeights(filter.minZ, filter.maxZ);
    this.lit?.keepHeights(filter.minZ, filter.maxZ);
    this.paint();
    this.litSteps = nothing;
    this.setTime(this.time);
  }

  /** Lights the marks of contacts up. */
  lightContacts(contacts: Iterable<number>): void {
    this.surroundings?.light(contacts);
    this.invalidate();
  }

  /** From now on, clicks and the pointer find places to measure. */
  startMeasuring(): void {
    this.isMeasuring = true;
    this.canvas.style.cursor = 'crosshair';
  }

  endMeasuring(): void {
    this.isMeasuring = false;
    this.canvas.style.cursor = '';
    this.showMeasurement([], null);
  }

  /** Draws places that have been chosen, with a line between two of them, and one that could be chosen next. */
  showMeasurement(chosen: Vector[], next: Vector | null): void {
    this.measure.show(chosen, next);
    this.invalidate();
  }

  show(layer: Layer, is: boolean): void {
    this.shown[layer] = is;
    this.lines.mesh.visible = this.shown.path;
    this.frames.visible = this.shown.frames;
    if (this.travel) this.travel.visible = this.shown.travel;
    if (this.grid) this.grid.visible = this.shown.grid;
    if (this.stock) this.stock.visible = this.shown.stock && !this.hasStock;
    this.showBodies();
    if (layer === 'rapids') this.paint();
    this.setTime(this.time);
  }

  /** Millimeters of a side of the grid's squares. */
  get cell(): number {
    return (this.grid?.userData.cell as number | undefined) ?? 0;
  }

  /** Moves the tool to where it is then, and lights what it is doing up. */
  setTime(time: number): void {
    this.time = time;
    const place = this.path.at(time);
    const tool = this.path.facts.tools[place.step < 0 ? 0 : this.path.stepTool[place.step]];
    this.tool.dress(tool, this.theme, this.size);
    this.isToolKnown = this.surroundings?.mount(codeOf(tool.name), tool.length) ?? false;
    this.toolLength = tool.length ?? 0;
    this.surroundings?.touchAt(time);
    this.cutStock?.setTime(time);
    this.pose(place.tip, place.b, place.c);
    if (this.travel) this.travel.position.z = this.travel.userData.height - (tool.length ?? 0);
    this.lines.set({ reached: place.point - 1, reachedPart: place.part });
    this.fade();
    this.light(this.selected ?? { start: place.step, end: place.step + 1 });
    this.invalidate();
  }

  /** Puts the tool and the head somewhere, on the path or not, until the time is another. */
  pose(tip: Vector, b: number, c: number): void {
    const at = new THREE.Vector3(...tip);
    const turns = this.path.facts.turnsTool;
    this.tool.object.visible = this.shown.tool && !this.isToolKnown && this.opacity > 0;
    this.head.object.visible = this.shown.head && turns && this.path.turned.length > 0 && !this.hasSpindle;
    this.surroundings?.place(tip, b, c, this.toolLength);
    this.carryCutStock();
    this.tool.place(at, turns ? b : 0, turns ? c : 0);
    this.head.place(at, turns ? b : 0, turns ? c : 0, this.tool.length, this.theme);
    this.tip.position.copy(at);
    this.invalidate();
  }

  look(from: Look): void {
    this.camera.position.set(...looks[from]).normalize().multiplyScalar(2 * this.size);
    this.controls.target.set(0, 0, 0);
    this.fit();
  }

  /** Brings what is cut into view, or with `whole` all of the path and what surrounds it, from where one looks. */
  fit(whole = false): void {
    const { min, max } = whole ? this.everything() : this.worked();
    const middle = new THREE.Vector3(...min).add(new THREE.Vector3(...max)).multiplyScalar(0.5).sub(this.center);
    const offset = this.camera.position.clone().sub(this.controls.target);
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).add(offset.setLength(this.reach));
    this.camera.lookAt(middle);
    this.camera.updateMatrixWorld();
    const [right, up] = [new THREE.Vector3(), new THREE.Vector3()];
    this.camera.matrixWorld.extractBasis(right, up, new THREE.Vector3());
    const extent = (direction: THREE.Vector3) =>
      [0, 1, 2].reduce((sum, i) => sum + Math.abs(direction.getComponent(i)) * (max[i] - min[i]), 0);
    const { clientWidth, clientHeight } = this.container;
    const free = Math.max(clientWidth - this.covered, clientWidth / 4) / Math.max(1, clientHeight);
    // Where nothing is cut yet, there is the tool to see, and not its inside.
    const wanted = Math.max(extent(right) / free, extent(up), this.path.work ? 5 : 500);
    this.camera.zoom = this.size / (1.25 * wanted);
    this.aimAt(middle);
  }

  /** Brings a place of the machine into the middle, where it is out of sight. */
  reveal(place: Vector): void {
    const { x, y } = this.project(place);
    const { clientWidth: width, clientHeight: height } = this.container;
    const isSeen = x >= edge && x <= width - this.covered - edge && y >= edge && y <= height - edge;
    if (!isSeen) this.aimAt(new THREE.Vector3(...place).sub(this.center));
  }

  /** Brings a place of the machine into the middle, from as near as shows what is around it. */
  approach(place: Vector): void {
    this.camera.zoom = Math.max(this.camera.zoom, this.size / nearView);
    this.aimAt(new THREE.Vector3(...place).sub(this.center));
  }

  /** Brings a part of the path into the middle, as large as it fits. */
  frame({ min, max }: { min: Vector; max: Vector }): void {
    const size = Math.max(Math.hypot(...max.map((value, i) => value - min[i])), smallestView / 2);
    this.camera.zoom = this.size / (2 * size);
    this.aimAt(new THREE.Vector3(...min).add(new THREE.Vector3(...max)).multiplyScalar(0.5).sub(this.center));
  }

  /** From now on, what is fitted into view leaves so many pixels free at the right. */
  leaveFree(pixels: number): void {
    this.covered = pixels;
  }

  /** Turns around what one looks at; degrees. */
  orbit(around: number, up: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const polar = new THREE.Spherical().setFromVector3(new THREE.Vector3(offset.x, offset.z, -offset.y));
    polar.theta -= THREE.MathUtils.degToRad(around);
    polar.phi = Math.min(Math.max(polar.phi - THREE.MathUtils.degToRad(up), 1e-4), Math.PI - 1e-4);
    const turned = new THREE.Vector3().setFromSpherical(polar);
    this.camera.position.copy(this.controls.target).add(new THREE.Vector3(turned.x, -turned.z, turned.y));
    this.controls.update();
    this.invalidate();
  }

  zoom(factor: number): void {
    this.camera.zoom *= factor;
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }

  /** Where a place of the machine is on the canvas, in pixels of the page. */
  project(tip: Vector): { x: number; y: number } {
    this.camera.updateMatrixWorld();
    const at = new THREE.Vector3(...tip).sub(this.center).project(this.camera);
    return { x: ((at.x + 1) / 2) * this.container.clientWidth, y: ((1 - at.y) / 2) * this.container.clientHeight };
  }

  /** The line that a place on the canvas shows, pixels of the page; of those that are as near the foremost. */
  pick(x: number, y: number, reach = 1): Hit | null {
    const best = this.opacity > 0 ? this.pickOn(this.path, (step) => this.isShown(step), x, y, reach) : null;
    return best && { point: best.point, part: best.part };
  }

  private pickOn(path: Toolpath, shows: (step: number) => boolean, x: number, y: number, reach: number): NearHit | null {
    const { center } = this;
    if (path.stepCount === 0 || !this.shown.path) return null;
    const [width, height] = [this.container.clientWidth, this.container.clientHeight];
    this.camera.updateMatrixWorld();
    const m = new THREE.Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse).elements;
    let best: NearHit | null = null;
    let [x0, y0, z0] = [0, 0, 0];
    for (let point = 0; point < path.pointCount; ++point) {
      const [px, py, pz] = [path.tips[3 * point] - center.x, path.tips[3 * point + 1] - center.y, path.tips[3 * point + 2] - center.z];
      const x1 = ((m[0] * px + m[4] * py + m[8] * pz + m[12] + 1) / 2) * width - x;
      const y1 = ((1 - (m[1] * px + m[5] * py + m[9] * pz + m[13])) / 2) * height - y;
      const z1 = m[2] * px + m[6] * py + m[10] * pz + m[14];
      if (point > 0 && shows(path.pointStep[point])) {
        const [dx, dy] = [x1 - x0, y1 - y0];
        const square = dx * dx + dy * dy;
        const part = square > 1e-9 ? Math.min(1, Math.max(0, -(x0 * dx + y0 * dy) / square)) : 1;
        const distance = Math.hypot(x0 + part * dx, y0 + part * dy);
        const depth = z0 + part * (z1 - z0);
        const isBetter = !best || distance < best.distance - 2 || (distance < best.distance + 2 && depth < best.depth);
        if (distance <= near * reach && isBetter && this.isAtShownHeight(path, point, part)) best = { point, part, distance, depth };
      }
      [x0, y0, z0] = [x1, y1, z1];
    }
    return best;
  }

  /** The place to measure that a place on the canvas shows, pixels of the page: ends of moves, centers of arcs, corners of boxes and
   * centers of cylinders come before other places of the path and of bodies. */
  snap(x: number, y: number, reach = 1): Snap | null {
    const { clientWidth: width, clientHeight: height } = this.container;
    this.camera.updateMatrixWorld();
    const { path, center } = this;
    const m = new THREE.Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse).elements;
    let best: { snap: Snap; distance: number; depth: number } | null = null;
    const offer = (placeX: number, placeY: number, placeZ: number, snap: () => Snap) => {
      const [px, py, pz] = [placeX - center.x, placeY - center.y, placeZ - center.z];
      const dx = ((m[0] * px + m[4] * py + m[8] * pz + m[12] + 1) / 2) * width - x;
      const dy = ((1 - (m[1] * px + m[5] * py + m[9] * pz + m[13])) / 2) * height - y;
      const distance = Math.hypot(dx, dy);
      if (distance > nearSnap * reach) return;
      const depth = m[2] * px + m[6] * py + m[10] * pz + m[14];
      if (!best || distance < best.distance - 2 || (distance < best.distance + 2 && depth < best.depth)) best = { snap: snap(), distance, depth };
    };
    for (let step = 0; step < path.stepCount && this.shown.path; ++step) {
      if (!this.isShown(step)) continue;
      for (const point of [path.stepStart[step], path.stepStart[step + 1]]) {
        if (!this.isAtShownHeight(path, point, 1)) continue;
        const [px, py, pz] = [path.tips[3 * point], path.tips[3 * point + 1], path.tips[3 * point + 2]];
        offer(px, py, pz, () => ({ at: [px, py, pz], kind: 'end', line: path.stepLine[step] }));
      }
    }
    for (const snap of [...this.arcCenters(), ...this.bodyPoints()]) offer(...snap.at, () => snap);
    // The compiler does not see that `offer` has set it.
    const found = best as { snap: Snap } | null;
    return found?.snap ?? this.snapAnywhere(x, y, reach);
  }

  /** Places to measure besides the path's ends, nearest to a place first: for those who have no pointer. */
  snapsNear(place: Vector): Snap[] {
    const distance = ({ at }: Snap) => Math.hypot(...at.map((value, i) => value - place[i]));
    return [...this.bodyPoints(), ...this.arcCenters()].sort((one, other) => distance(one) - distance(other));
  }

  /** What surrounds the path, for who looks at it from outside. */
  get sceneModel(): SceneModel | null {
    return this.surroundings;
  }

  dispose(): void {
    this.isDisposed = true;
    this.resizing.disconnect();
    this.controls.dispose();
    this.lines.dispose();
    this.lit?.dispose();
    this.other?.dispose();
    this.surroundings?.dispose();
    this.cutStock?.dispose();
    this.measure.dispose();
    this.renderer.dispose();
    this.canvas.remove();
  }

  /** Brings a place of the scene into the middle of what nothing covers. */
  private aimAt(at: THREE.Vector3): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const right = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    const aside = ((this.covered / 2) * this.size) / this.camera.zoom / Math.max(1, this.container.clientHeight);
    this.controls.target.copy(at).addScaledVector(right, aside);
    this.camera.position.copy(this.controls.target).add(offset.setLength(this.reach));
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.invalidate();
  }

  private get aspect(): number {
    return this.container.clientWidth / Math.max(1, this.container.clientHeight);
  }

  /** How far the camera stands from what it looks at: all that is drawn is between them, or behind. */
  private get reach(): number {
    return 2 * this.size + 1000 + this.extent;
  }

  private isShown(step: number): boolean {
    const kind = this.path.stepKind[step];
    return kind !== Kind.Wait && (kind !== Kind.Rapid || this.shown.rapids) && !this.hidden?.[step];
  }

  private isAtShownHeight(path: Toolpath, point: number, part: number): boolean {
    const { minZ, maxZ } = this.filter;
    if (minZ === -Infinity && maxZ === Infinity) return true;
    const end = path.tips[3 * point + 2];
    const start = point > 0 ? path.tips[3 * point - 1] : end;
    const height = start + part * (end - start);
    return height >= minZ - 1e-3 && height <= maxZ + 1e-3;
  }

  private paint(): void {
    this.lines.paint(stepColors(this.path, this.mode, this.theme, this.markOf), (step) => this.isShown(step));
    this.other?.paint({ mode: this.mode, theme: this.theme, rapids: this.shown.rapids, filter: this.filter });
  }

  private get opacity(): number {
    return this.other ? Math.min(1, 2 * this.blended) : 1;
  }
  private get otherOpacity(): number {
    return Math.min(1, 2 * (1 - this.blended));
  }

  /** Where two paths are compared, what is to come is no less to be seen than what is done. */
  private fade(): void {
    const { opacity, otherOpacity, other } = this;
    const ahead = this.shown.ahead ? 1 : 0;
    this.tip.visible = opacity > 0;
    this.lines.set({ opacity, aheadOpacity: other ? opacity * ahead : 0.28 * ahead });
    if (!other) return;
    other.lines.mesh.visible = this.shown.path;
    other.lines.set({ opacity: otherOpacity, aheadOpacity: otherOpacity * ahead });
    other.tool.object.visible = this.shown.tool && otherOpacity > 0;
  }

  /** What is fitted into view. */
  private worked(): { min: Vector; max: Vector } {
    const boxes = [this.path, ...(this.other ? [this.other.path] : [])].map((path) => path.work ?? path);
    const extreme = (pick: (...values: number[]) => number, end: 'min' | 'max') => [0, 1, 2].map((i) => pick(...boxes.map((box) => box[end][i]))) as Vector;
    return { min: extreme(Math.min, 'min'), max: extreme(Math.max, 'max') };
  }

  /** Makes a model of what surrounds the path, unless there is one of the same. */
  private surround(): void {
    const { scene, contacts = [] } = this.path.facts;
    const source = JSON.stringify([scene, contacts]);
    if (scene && this.surroundings?.shows(source)) return;
    if (this.surroundings) {
      this.world.remove(this.surroundings.object);
      this.surroundings.dispose();
    }
    this.surroundings = scene ? new SceneModel(scene, contacts, source) : null;
    this.extent = 0;
    this.floor = Infinity;
    if (!this.surroundings) return;
    this.world.add(this.surroundings.object);
    this.surroundings.setTheme(this.theme);
    this.showBodies();
    const { tip, b, c } = this.path.at(0);
    this.surroundings.place(tip, b, c, 0);
    this.floor = this.surroundings.floor();
    // Bodies move with the axes, as far as the path is long.
    for (const { min, max } of this.surroundings.allBounds())
      for (const corner of [min, max]) this.extent = Math.max(this.extent, 2 * corner.distanceTo(this.center));
  }

  /** Makes a model of the stock that is cut in the path. */
  private placeCutStock(): void {
    if (this.cutStock) {
      this.world.remove(this.cutStock.object);
      this.cutStock.dispose();
      this.cutStock = null;
    }
    const { facts, cuts } = this.path;
    if (facts.stock && cuts.length > 0) {
      try {
        this.cutStock = new StockModel(new StockTimeline(facts.stock, cuts), this.path, this.theme);
        this.cutStock.colorBy(this.stockMode);
        this.cutStock.cutOff(this.section);
        this.world.add(this.cutStock.object);
      } catch (problem) {
        // The path is shown all the same, with the blank.
        console.error(problem);
      }
    }
    this.showBodies();
  }

  /** The stock is on the table, or rests. */
  private carryCutStock(): void {
    const { cutStock, surroundings } = this;
    if (!cutStock) return;
    const pose = surroundings?.poseOf(cutStock.facts.onTable ? 'workpiece' : 'machine');
    if (pose) cutStock.object.matrix.copy(pose);
    cutStock.object.matrixWorldNeedsUpdate = true;
  }

  /** A blank of the scene makes room for the stock that is cut. */
  private showBodies(): void {
    const isShown = (role: Role) => this.shown[layerOf[role]] && !(role === 'stock' && this.cutStock);
    this.surroundings?.show(isShown, this.shown.tool);
    if (this.cutStock) this.cutStock.object.visible = this.shown.stock;
  }

  private everything(): { min: Vector; max: Vector } {
    const box = new THREE.Box3(new THREE.Vector3(...this.path.min), new THREE.Vector3(...this.path.max));
    if (this.other) box.expandByPoint(new THREE.Vector3(...this.other.path.min)).expandByPoint(new THREE.Vector3(...this.other.path.max));
    if (this.surroundings) box.union(this.surroundings.bounds());
    if (this.cutStock && this.shown.stock) box.union(this.cutStock.bounds());
    return { min: box.min.toArray(), max: box.max.toArray() };
  }

  private onClick({ x, y, reach }: Click): void {
    if (this.isMeasuring) {
      this.onSnap(this.snap(x, y, reach));
      return;
    }
    const contact = this.contactAt(x, y, reach);
    if (contact !== null) return this.onContact(contact);
    const hit = this.pick(x, y, reach);
    const other = this.pickOther(x, y, reach);
    if (other) return this.onPickOther(other);
    const cut = this.stockAt(x, y);
    if (!cut || (hit && !this.isHidden(this.placeOn(hit), cut))) this.onPick(hit);
    else if (cut.line >= 0) this.onCut(cut.line);
  }

  /** The line of the other path that a place on the canvas shows, where none of this one is as near. */
  private pickOther(x: number, y: number, reach: number): Hit | null {
    const { other } = this;
    if (!other || this.otherOpacity === 0) return null;
    const hit = this.pickOn(other.path, (step) => other.shows(step), x, y, reach);
    const own = this.opacity > 0 ? this.pickOn(this.path, (step) => this.isShown(step), x, y, reach) : null;
    return hit && (!own || hit.distance < own.distance - 2) ? hit : null;
  }

  /** The stock that a place on the canvas shows. */
  private stockAt(x: number, y: number): StockHit | null {
    if (!this.cutStock || !this.shown.stock) return null;
    const { ray } = this.rayAt(x, y);
    return this.cutStock.hit(ray.origin.add(this.center), ray.direction);
  }

  private rayAt(x: number, y: number): THREE.Raycaster {
    const ray = new THREE.Raycaster();
    const { clientWidth, clientHeight } = this.container;
    this.camera.updateMatrixWorld();
    ray.setFromCamera(new THREE.Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.camera);
    return ray;
  }

  private placeOn({ point, part }: Hit): Vector {
    const [from, to] = [this.path.tipOf(Math.max(point - 1, 0)), this.path.tipOf(point)];
    return to.map((value, i) => from[i] + part * (value - from[i])) as Vector;
  }

  /** Whether the stock hides a place of the path, and is not merely as near as a place that is pointed at. */
  private isHidden(place: Vector, { at }: StockHit): boolean {
    const direction = this.camera.getWorldDirection(new THREE.Vector3());
    const behind = new THREE.Vector3(...place).sub(new THREE.Vector3(...at)).dot(direction);
    return behind > 0.5 + (2 * near) / this.pixelsPerMillimeter;
  }

  private get pixelsPerMillimeter(): number {
    return (this.camera.zoom * Math.max(1, this.container.clientHeight)) / this.size;
  }

  /** The contact whose mark is nearest there. */
  private contactAt(x: number, y: number, reach: number): number | null {
    let best = { contact: null as number | null, distance: near * reach };
    this.surroundings?.contacts.forEach((_, contact) => {
      const at = this.project(this.surroundings!.markAt(contact));
      const distance = Math.hypot(at.x - x, at.y - y);
      if (distance < best.distance) best = { contact, distance };
    });
    return best.contact;
  }

  /** Finds what the pointer is at, once for each picture. */
  private hover(x: number, y: number): void {
    const isAsked = this.hovered !== null;
    this.hovered = { x, y };
    if (isAsked) return;
    requestAnimationFrame(() => {
      const { hovered } = this;
      this.hovered = null;
      if (hovered && this.isMeasuring && !this.isDisposed) this.onHover(this.snap(hovered.x, hovered.y));
    });
  }

  private snapAnywhere(x: number, y: number, reach: number): Snap | null {
    const hit = this.pick(x, y, reach);
    const { path } = this;
    const cut = this.stockAt(x, y);
    if (hit && !(cut && this.isHidden(this.placeOn(hit), cut)))
      return { at: this.placeOn(hit), kind: 'path', line: path.stepLine[path.pointStep[hit.point]] };
    const ray = this.rayAt(x, y);
    this.world.updateMatrixWorld();
    const found = this.surroundings?.hit(ray);
    const isBody = found && !(cut && cut.distance < found.at.distanceTo(ray.ray.origin));
    if (isBody) return { at: found.at.add(this.center).toArray(), kind: 'surface', body: found.body };
    return cut && { at: this.cutStock!.placeOf(cut), kind: 'stock', ...(cut.line >= 0 && { line: cut.line }) };
  }

  private bodyPoints(): Snap[] {
    return (this.surroundings?.points() ?? []).map(({ at, kind, body }) => ({ at: at.toArray(), kind, body }));
  }

  private arcCenters(): Snap[] {
    const { path } = this;
    if (!this.centers) {
      this.centers = [];
      for (let step = 0; step < path.stepCount; ++step) {
        const at = arcCenter(path, step);
        if (at) this.centers.push({ at, kind: 'center', line: path.stepLine[step] });
      }
    }
    if (!this.shown.path) return [];
    // Centers of arcs of the same line that are hidden are hidden, too.
    return this.centers.filter(({ line }) => this.isShown(path.stepsOf(line!).start));
  }

  /** What the theme colors. */
  private furnish(): void {
    for (const old of [this.frames, this.travel, this.grid, this.stock]) if (old) this.world.remove(old);
    this.frames = frames(this.path, this.theme);
    this.travel = travel(this.path, this.theme);
    if (this.travel) this.travel.userData.height = this.travel.position.z;
    const { min, max } = this.path.work ?? this.path;
    const floor = Math.min(min[2], this.floor, this.cutStock?.bounds().min.z ?? Infinity);
    this.grid = grid(new THREE.Vector3(min[0], min[1], floor), new THREE.Vector3(...max), this.theme);
    this.stock = stock(this.stockKnown ?? this.path.work, this.theme);
    for (const each of [this.frames, this.travel, this.grid, this.stock]) if (each) this.world.add(each);
    if (this.stock) this.stock.visible = this.shown.stock && !this.hasStock;
    this.frames.visible = this.shown.frames;
    if (this.travel) this.travel.visible = this.shown.travel;
    this.grid.visible = this.shown.grid;
  }

  private light(steps: Steps): void {
    if (steps.start === this.litSteps.start && steps.end === this.litSteps.end) return;
    this.litSteps = steps;
    if (this.lit) {
      this.scene.remove(this.lit.mesh);
      this.lit.dispose();
      this.lit = null;
    }
    if (steps.start < 0 || steps.start >= steps.end) return;
    const [start, end] = [this.path.stepStart[steps.start], this.path.stepStart[steps.end]];
    if (start === end) return;
    this.lit = new PathLines(this.path, this.center, start, end);
    this.lit.alwaysInFront = true;
    this.lit.keepHeights(this.filter.minZ, this.filter.maxZ);
    const { highlight } = palettes[this.theme];
    this.lit.paint(this.isMarked ? stepColors(this.path, 'change', this.theme, this.markOf) : () => highlight, (step) => this.isShown(step));
    this.scene.add(this.lit.mesh);
    this.resizeLines();
  }

  /** Whether the size is another one. */
  private resize(): boolean {
    const { clientWidth, clientHeight } = this.container;
    const size = this.renderer.getSize(new THREE.Vector2());
    if (clientWidth === 0 || clientHeight === 0 || (size.x === clientWidth && size.y === clientHeight)) return false;
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(clientWidth, clientHeight);
    this.frameCamera();
    this.resizeLines();
    return true;
  }

  /** What of the world the camera sees. */
  private frameCamera(): void {
    const half = this.size / 2;
    Object.assign(this.camera, { left: -half * this.aspect, right: half * this.aspect, top: half, bottom: -half });
    this.camera.near = 0;
    this.camera.far = 4 * this.reach;
    const offset = this.camera.position.clone().sub(this.controls.target).setLength(this.reach);
    this.camera.position.copy(this.controls.target).add(offset);
    this.camera.updateProjectionMatrix();
  }

  private resizeLines(): void {
    const ratio = this.renderer.getPixelRatio();
    const { clientWidth, clientHeight } = this.container;
    for (const lines of [this.lines, this.lit, this.other?.lines, this.other?.litLines]) lines?.resize(clientWidth * ratio, clientHeight * ratio);
    for (const lines of [this.lines, this.other?.lines])
      lines?.set({ width: 1.6 * ratio, dashedWidth: 1.2 * ratio, thickWidth: 2.6 * ratio, pixelRatio: ratio });
    for (const [lit, opacity] of [[this.lit, 0.9 * this.opacity], [this.other?.litLines, 0.9 * this.otherOpacity]] as const)
      lit?.set({ width: 4.5 * ratio, dashedWidth: 3 * ratio, thickWidth: 5 * ratio, pixelRatio: ratio, opacity, aheadOpacity: opacity });
  }

  private invalidate(): void {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      if (this.isDue && !this.isDisposed) this.draw();
    });
  }

  private draw(): void {
    this.isDue = false;
    const height = Math.max(1, this.container.clientHeight);
    const millimeters = this.size / this.camera.zoom / height; // Of a pixel of the page.
    for (const frame of this.frames.children) frame.scale.setScalar(frameSize * millimeters);
    this.tip.scale.setScalar((12 / height) * (this.size / this.camera.zoom));
    this.surroundings?.scaleMarks(millimeters);
    this.measure.scale(millimeters);
    this.camera.updateMatrixWorld();
    if (this.cutStock && this.shown.stock && !this.cutStock.update(this.camera, 1 / millimeters)) this.invalidate();
    const scale = { pixelsPerMillimeter: this.renderer.getPixelRatio() / millimeters };
    for (const lines of [this.lines, this.lit, this.other?.lines, this.other?.litLines]) lines?.set(scale);
    this.renderer.render(this.scene, this.camera);
  }
}

const sizeOf = (path: Toolpath) => Math.max(Math.hypot(...path.max.map((value, i) => value - path.min[i])), 20);

function dot(): THREE.Texture {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const context = canvas.getContext('2d')!;
  context.beginPath();
  context.arc(32, 32, 22, 0, 2 * Math.PI);
  context.lineWidth = 10;
  context.strokeStyle = 'white';
  context.stroke();
  return new THREE.CanvasTexture(canvas);
}

/** What surrounds the program, in the picture: bodies on the parts of the machine, the tool in its holder and the spindle nose, and
 * marks where they touch. */
import * as THREE from 'three';
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import { mixed, number, palettes, type Theme } from './colors';
import { jointsOf, poseBesideWorkpiece, spindleLink, workpieceLink } from './link_pose';
import { bodyOf, links, severities, severityOf, trianglesOf, type Contact, type CylinderShape, type Link, type Outline, type Role, type Scene, type SceneBody, type Severity } from './scene';
import type { Vector } from './toolpath';

/** How much of a body hides what is behind it: a part is looked into, and a machine looked through. */
const opacities: Record<Role, number> = { fixture: 1, spoilboard: 1, target: 0.4, stock: 0.18, machine: 0.3 };
const toolParts = ['cutter', 'shank', 'holder', 'nose'] as const;
type ToolPart = (typeof toolParts)[number];
const partOpacities: Record<ToolPart, number> = { cutter: 1, shank: 1, holder: 0.85, nose: 0.6 };

/** Edges of meshes with more triangles take too long to find. */
const maxTrianglesWithEdges = 60_000;
/** Degrees between two faces that meet at an edge which is drawn. */
const edgeAngle = 25;

/** A place of a body that a measurement can start from. */
export interface BodyPoint {
  at: THREE.Vector3;
  body: SceneBody;
  kind: 'corner' | 'axis';
}

interface Part {
  body: SceneBody;
  mesh: THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial>;
  edges: THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial> | null;
  link: Link;
}

export class SceneModel {
  readonly object = new THREE.Group();
  private readonly carriers = new Map<Link, THREE.Group>();
  private readonly parts: Part[] = [];
  /** Its origin is the spindle nose. */
  private readonly spindle = new THREE.Group();
  private readonly tool = new THREE.Group();
  private readonly toolMaterials: Record<ToolPart, THREE.MeshStandardMaterial>;
  private readonly nose: THREE.Mesh | null;
  private readonly marks: THREE.Sprite[];
  private readonly markMaterials: Record<Severity, THREE.SpriteMaterial>;
  private readonly lit = new Set<number>();
  private mounted: string | null = null;
  private theme: Theme = 'light';
  /** Of each contact. */
  private readonly touchedBodies: (SceneBody | undefined)[];
  private touched: ReadonlyMap<SceneBody, Severity> = new Map();

  constructor(
    readonly scene: Scene,
    readonly contacts: Contact[],
    private readonly source: string,
  ) {
    for (const link of links) {
      const carrier = new THREE.Group();
      carrier.matrixAutoUpdate = false;
      this.carriers.set(link, carrier);
      this.object.add(carrier);
    }
    for (const body of scene.bodies) this.add(body);
    this.toolMaterials = Object.fromEntries(toolParts.map((part) => [part, toolMaterial(partOpacities[part])])) as Record<
      ToolPart,
      THREE.MeshStandardMaterial
    >;
    this.nose = scene.nose ? this.revolved(scene.nose, 'nose') : null;
    if (this.nose) this.spindle.add(this.nose);
    this.spindle.add(this.tool);
    this.carriers.get(spindleLink(scene.kinematics))!.add(this.spindle);
    this.markMaterials = Object.fromEntries(
      severities.map((severity) => [severity, new THREE.SpriteMaterial({ map: markTexture(severity), transparent: true, depthTest: false })]),
    ) as Record<Severity, THREE.SpriteMaterial>;
    this.touchedBodies = contacts.map((contact) => bodyOf(contact, scene));
    this.marks = contacts.map((contact, i) => this.mark(contact, this.touchedBodies[i]));
  }

  /** Whether a model of this scene and these contacts is this one. */
  shows(source: string): boolean {
    return this.source === source;
  }

  /** Whether it draws the spindle, so that none of a common size need stand for it. */
  get hasSpindle(): boolean {
    const carries = spindleLink(this.scene.kinematics);
    return this.nose !== null || this.parts.some(({ link }) => link === carries);
  }

  hasRole(role: Role): boolean {
    return this.scene.bodies.some((body) => body.role === role);
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    const { bodyEdge, cutter, holder, contacts } = palettes[theme];
    for (const { edges } of this.parts) edges?.material.color.setHex(number(bodyEdge));
    this.paintBodies();
    for (const part of toolParts) this.toolMaterials[part].color.setHex(number(part === 'cutter' ? cutter : holder));
    this.toolMaterials.shank.color.setHex(number(mixed(cutter, holder)));
    for (const severity of severities) this.markMaterials[severity].color.setHex(number(contacts[severity]));
  }

  /** Shows which bodies are hit at a time. */
  touchAt(time: number): void {
    const touched = new Map<SceneBody, Severity>();
    this.contacts.forEach((contact, i) => {
      const body = this.touchedBodies[i];
      if (!body || time < contact.time || time > contact.endTime) return;
      const [severity, known] = [severityOf(contact), touched.get(body)];
      if (!known || severities.indexOf(severity) < severities.indexOf(known)) touched.set(body, severity);
    });
    if (touched.size === this.touched.size && [...touched].every(([body, severity]) => this.touched.get(body) === severity)) return;
    this.touched = touched;
    this.paintBodies();
  }

  /** The bodies that are hit now, by their severities. */
  get touchedNow(): ReadonlyMap<SceneBody, Severity> {
    return this.touched;
  }

  /** The lower end of what the setup puts into the machine, in the frame of the path; infinite where it puts nothing there. */
  floor(): number {
    return Math.min(Infinity, ...this.parts.filter(({ body }) => body.role !== 'machine').map((part) => around(part).min.z));
  }

  /** Which roles are seen, and whether the tool with the spindle nose is. */
  show(isShown: (role: Role) => boolean, tool: boolean): void {
    for (const { body, mesh } of this.parts) mesh.visible = isShown(body.role);
    this.spindle.visible = tool;
  }

  /** Puts a tool into the spindle. Returns whether its shape is known, or there is none to draw: nothing then stands for it. */
  mount(code: string | null, length: number | null): boolean {
    const shape = code === null ? null : (this.scene.tools[code] ?? null);
    // Where the length is unknown, so is the place of the nose.
    if (this.nose) this.nose.visible = code === null || shape !== null || length !== null;
    if (code !== this.mounted) {
      this.mounted = code;
      for (const old of this.tool.children) (old as THREE.Mesh).geometry.dispose();
      this.tool.clear();
      for (const part of ['cutter', 'shank', 'holder'] as const) {
        const outline = shape?.[part];
        if (outline) this.tool.add(this.revolved(outline, part));
      }
      this.tool.position.z = -(shape?.length ?? 0);
    }
    return code === null || this.tool.children.length > 0;
  }

  /** Moves all of it to where the machine is that holds the tip there; `length` where the scene does not know the tool. */
  place(tip: Vector, b: number, c: number, length: number): void {
    const { kinematics, tools } = this.scene;
    const known = this.mounted === null ? undefined : tools[this.mounted];
    const joints = jointsOf(kinematics, tip, b, c, known?.length ?? length);
    for (const [link, carrier] of this.carriers) {
      carrier.matrix.copy(poseBesideWorkpiece(kinematics, link, joints));
      carrier.matrixWorldNeedsUpdate = true;
    }
  }

  /** Where what stands on a link is, in the frame of the path. */
  poseOf(on: SceneBody['on']): THREE.Matrix4 {
    return this.carriers.get(this.linkOf(on))!.matrix;
  }

  /** Lights marks of contacts up. */
  light(contacts: Iterable<number>): void {
    this.lit.clear();
    for (const each of contacts) this.lit.add(each);
    this.marks.forEach((sprite, i) => (sprite.renderOrder = this.lit.has(i) ? 7 : 6));
  }

  /** Keeps marks at their size on the screen. */
  scaleMarks(millimetersPerPixel: number): void {
    this.marks.forEach((sprite, i) => sprite.scale.setScalar((this.lit.has(i) ? 30 : 18) * millimetersPerPixel));
  }

  /** Where the mark of a contact is now, in the frame of the path. */
  markAt(contact: number): Vector {
    const sprite = this.marks[contact];
    return this.inPath(sprite.position.clone(), sprite.parent!).toArray();
  }

  /** Corners of boxes and centers of both ends of cylinders that are seen, in the frame of the path. */
  points(): BodyPoint[] {
    const points: BodyPoint[] = [];
    for (const { body, mesh } of this.parts) {
      if (!mesh.visible) continue;
      const put = (at: THREE.Vector3, kind: BodyPoint['kind']) =>
        points.push({ at: this.inPath(at.add(new THREE.Vector3(...body.at)), mesh.parent!), body, kind });
      if (body.box) {
        for (let corner = 0; corner < 8; ++corner)
          put(new THREE.Vector3(body.box[corner & 1][0], body.box[(corner >> 1) & 1][1], body.box[corner >> 2][2]), 'corner');
      } else if (body.cylinder) {
        const { at, axis, height } = body.cylinder;
        for (const along of [0, height]) put(new THREE.Vector3(...at).addScaledVector(new THREE.Vector3(...axis).normalize(), along), 'axis');
      }
    }
    return points;
  }

  /** Where a ray first meets a body that is seen, in the frame of the ray. */
  hit(ray: THREE.Raycaster): { at: THREE.Vector3; body: SceneBody } | null {
    const meshes = this.parts.filter(({ mesh }) => mesh.visible);
    const [first] = ray.intersectObjects(meshes.map(({ mesh }) => mesh), false);
    return first ? { at: first.point, body: meshes.find(({ mesh }) => mesh === first.object)!.body } : null;
  }

  /** Around the bodies that are seen, in the frame of the path; empty where there are none. */
  bounds(): THREE.Box3 {
    const box = new THREE.Box3();
    for (const part of this.parts) if (part.mesh.visible) box.union(around(part));
    return box;
  }

  /** Around each body, seen or not. */
  allBounds(): THREE.Box3[] {
    return this.parts.map(around);
  }

  /** Where a body is now, in the frame of the path: its corners, for tests and for fitting. */
  boundsOf(name: string): { min: Vector; max: Vector } | null {
    const part = this.parts.find(({ body }) => body.name === name);
    if (!part) return null;
    part.mesh.updateMatrix();
    const places = part.mesh.geometry.getAttribute('position');
    const box = new THREE.Box3();
    for (let i = 0; i < places.count; ++i)
      box.expandByPoint(this.inPath(new THREE.Vector3().fromBufferAttribute(places, i).applyMatrix4(part.mesh.matrix), part.mesh.parent!));
    return { min: box.min.toArray(), max: box.max.toArray() };
  }

  /** The matrix of the spindle nose, in the frame of the path. */
  get spindlePose(): THREE.Matrix4 {
    return this.spindle.parent!.matrix.clone();
  }

  dispose(): void {
    this.object.traverse((each) => {
      if (!(each instanceof THREE.Mesh || each instanceof THREE.LineSegments)) return;
      (each.geometry as THREE.BufferGeometry).dispose();
      (each.material as THREE.Material).dispose();
    });
    for (const material of Object.values(this.toolMaterials)) material.dispose();
    for (const material of Object.values(this.markMaterials)) {
      material.map?.dispose();
      material.dispose();
    }
  }

  /** Bodies that are hit are fainter than the marks on them. */
  private paintBodies(): void {
    const { background, bodies, contacts } = palettes[this.theme];
    for (const { body, mesh } of this.parts) {
      const severity = this.touched.get(body);
      mesh.material.color.setHex(number(severity ? mixed(contacts[severity], background) : bodies[body.role]));
    }
  }

  private inPath(at: THREE.Vector3, carrier: THREE.Object3D): THREE.Vector3 {
    return at.applyMatrix4(carrier.matrix);
  }

  private linkOf(on: SceneBody['on']): Link {
    return on === 'workpiece' ? workpieceLink(this.scene.kinematics) : on;
  }

  private add(body: SceneBody): void {
    const geometry = shapeOf(body);
    if (!geometry) return;
    const opacity = opacities[body.role];
    const material = new THREE.MeshStandardMaterial({
      roughness: 0.85,
      metalness: 0.05,
      flatShading: body.mesh !== undefined,
      transparent: opacity < 1,
      opacity,
      depthWrite: opacity === 1,
      side: body.mesh ? THREE.DoubleSide : THREE.FrontSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.position.set(...body.at);
    let edges: Part['edges'] = null;
    if (geometry.getAttribute('position').count / 3 <= maxTrianglesWithEdges) {
      const isFaint = body.role === 'machine' || body.role === 'stock';
      edges = new THREE.LineSegments(
        new THREE.EdgesGeometry(geometry, edgeAngle),
        new THREE.LineBasicMaterial({ transparent: true, opacity: isFaint ? 0.45 : 0.85 }),
      );
      mesh.add(edges);
    }
    const link = this.linkOf(body.on);
    this.carriers.get(link)!.add(mesh);
    this.parts.push({ body, mesh, edges, link });
  }

  private revolved(outline: Outline, part: ToolPart): THREE.Mesh {
    return new THREE.Mesh(revolve(outline), this.toolMaterials[part]);
  }

  /** A contact's point moves with the body that is hit. */
  private mark(contact: Contact, body: SceneBody | undefined): THREE.Sprite {
    const sprite = new THREE.Sprite(this.markMaterials[severityOf(contact)]);
    sprite.position.set(...contact.point);
    sprite.renderOrder = 6;
    this.carriers.get(this.linkOf(body?.on ?? 'workpiece'))!.add(sprite);
    return sprite;
  }
}

/** A box around a body, in the frame of the path. */
function around({ mesh }: Part): THREE.Box3 {
  mesh.updateMatrix();
  mesh.geometry.computeBoundingBox();
  return mesh.geometry.boundingBox!.clone().applyMatrix4(mesh.matrix).applyMatrix4(mesh.parent!.matrix);
}

function toolMaterial(opacity: number): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({
    roughness: 0.5,
    metalness: 0.35,
    transparent: opacity < 1,
    opacity,
    side: THREE.DoubleSide,
  });
}

/** Null where a body has no shape, or none with an extent. */
function shapeOf({ box, cylinder, mesh }: SceneBody): THREE.BufferGeometry | null {
  if (box) {
    const size = box[1].map((value, i) => value - box[0][i]);
    return new THREE.BoxGeometry(...size).translate(box[0][0] + size[0] / 2, box[0][1] + size[1] / 2, box[0][2] + size[2] / 2);
  }
  if (cylinder) return cylinderGeometry(cylinder);
  if (!mesh) return null;
  const triangles = trianglesOf(mesh.positions);
  if (triangles.length === 0) return null;
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(triangles, 3));
  geometry.computeVertexNormals();
  return geometry;
}

function cylinderGeometry({ at, axis, height, radius }: CylinderShape): THREE.BufferGeometry {
  const up = new THREE.Vector3(0, 1, 0);
  const turned = new THREE.Quaternion().setFromUnitVectors(up, new THREE.Vector3(...axis).normalize());
  return new THREE.CylinderGeometry(radius, radius, height, 48)
    .translate(0, height / 2, 0)
    .applyQuaternion(turned)
    .translate(...at);
}

/** A body of revolution about z. Each piece of the outline has normals of its own, so that steps look like steps. */
export function revolve(outline: Outline): THREE.BufferGeometry {
  if (outline.length === 0) return new THREE.BufferGeometry();
  const points = outline.map(([z, radius]) => new THREE.Vector2(Math.max(0, radius), z));
  // Ends are closed.
  if (points[0].x > 0) points.unshift(new THREE.Vector2(0, points[0].y));
  if (points.at(-1)!.x > 0) points.push(new THREE.Vector2(0, points.at(-1)!.y));
  const pieces: THREE.BufferGeometry[] = [];
  for (let i = 1; i < points.length; ++i)
    if (!points[i].equals(points[i - 1])) pieces.push(new THREE.LatheGeometry([points[i - 1], points[i]], 48));
  if (pieces.length === 0) return new THREE.BufferGeometry();
  const whole = mergeGeometries(pieces).rotateX(Math.PI / 2);
  for (const each of pieces) each.dispose();
  return whole;
}

/** White, to be colored; each severity has a shape of its own. */
function markTexture(severity: Severity): THREE.Texture {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const context = canvas.getContext('2d')!;
  const polygons = { error: [32, 4, 60, 32, 32, 60, 4, 32], warning: [32, 6, 59, 55, 5, 55], info: [] };
  context.beginPath();
  if (severity === 'info') context.arc(32, 32, 24, 0, 2 * Math.PI);
  const corners: number[] = polygons[severity];
  for (let i = 0; i < corners.length; i += 2) context.lineTo(corners[i], corners[i + 1]);
  context.closePath();
  context.fillStyle = 'white';
  context.fill();
  context.lineWidth = 5;
  context.strokeStyle = 'rgb(0 0 0 / 0.55)';
  context.stroke();
  context.fillStyle = 'rgb(0 0 0 / 0.8)';
  context.fillRect(29, 18, 6, 18);
  context.fillRect(29, 40, 6, 6);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  return texture;
}

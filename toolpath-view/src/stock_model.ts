/** The stock in the picture, cut up to the present moment. */
import * as THREE from 'three';
import { mixed, number, palettes, type Theme } from './colors';
import type { StockFacts } from './stock';
import { stockColors, type StockMode } from './stock_colors';
import type { Surface } from './stock_mesh';
import { hitStock, type Section, type StockHit } from './stock_ray';
import { sectionFaces } from './stock_section';
import { maxLevel, SurfaceBuilder, tileSize, type SurfaceColors } from './stock_surface';
import { StockTiles, type Tile, type Update } from './stock_tiles';
import type { StockTimeline } from './stock_timeline';
import type { Toolpath, Vector } from './toolpath';

/** Pixels of the page that a cell of the picture may be wide. */
const cellPixels = 1.6;

export class StockModel {
  readonly object = new THREE.Group();
  /** What the last update has cost. */
  lastUpdate: Update = { tiles: 0, triangles: 0, bytes: 0, isMore: false };

  private readonly builder: SurfaceBuilder;
  private readonly tiles: StockTiles;
  private readonly meshes = new Map<Tile, THREE.Mesh>();
  private readonly material = new THREE.MeshStandardMaterial({
    vertexColors: true,
    roughness: 0.75,
    metalness: 0.05,
    side: THREE.DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 2,
  });
  private colors: SurfaceColors;
  private mode: StockMode = 'tool';
  private section: Section | null = null;
  private readonly plane = new THREE.Plane();
  /** Where the section cuts material. */
  private readonly faces = new THREE.Mesh(
    new THREE.BufferGeometry(),
    new THREE.MeshBasicMaterial({ side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 }),
  );
  private areFacesDue = false;
  private readonly zRange: [number, number];

  constructor(
    readonly timeline: StockTimeline,
    private readonly path: Toolpath,
    private theme: Theme,
  ) {
    const { dexels, facts } = timeline;
    this.builder = new SurfaceBuilder(dexels, facts);
    this.object.matrixAutoUpdate = false;
    this.tiles = new StockTiles(
      dexels.columns,
      dexels.rows,
      ({ column, row }, level) => this.builder.build(column, row, level, this.colors),
      (tile, surface) => this.draw(tile, surface),
    );
    this.object.add(this.faces);
    this.faces.visible = false;
    this.colors = this.paint();
    timeline.onChange = (first, length) => {
      this.tiles.change(first, length);
      this.areFacesDue = true;
    };
    this.zRange = timeline.heights;
  }

  get facts(): StockFacts {
    return this.timeline.facts;
  }

  /** Of all that is drawn. */
  get triangles(): number {
    return this.tiles.triangles;
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.repaint();
  }

  colorBy(mode: StockMode): void {
    if (mode === this.mode) return;
    this.mode = mode;
    this.repaint();
  }

  /** Leaves out what is on one side of a plane. */
  cutOff(section: Section | null): void {
    this.section = section;
    this.areFacesDue = true;
    this.material.clippingPlanes = section ? [this.plane] : null;
    this.material.needsUpdate = true;
    this.faces.visible = section !== null;
  }

  /** The lowest and the highest place of the blank along an axis. */
  extent(axis: 0 | 1 | 2): [number, number] {
    if (axis === 2) return this.zRange;
    const { first, spacing, columns, rows } = this.facts;
    return [first[axis] - spacing[axis] / 2, first[axis] + ([columns, rows][axis] - 0.5) * spacing[axis]];
  }

  /** Where a ray first meets the stock, both in the frame of the path. */
  hit(origin: THREE.Vector3, direction: THREE.Vector3): StockHit | null {
    const inverse = this.object.matrix.clone().invert();
    const from = origin.clone().applyMatrix4(inverse).toArray();
    const towards = direction.clone().transformDirection(inverse).toArray();
    const hit = hitStock(this.timeline.dexels, this.facts, from, towards, this.section);
    return hit && { ...hit, at: this.inPath(hit.at) };
  }

  /** The exact place of the dexel that a ray has hit: heights are exact in its middle. */
  placeOf({ at, dexel, face }: StockHit): Vector {
    if (face !== 'top') return at;
    const { first, spacing, columns } = this.facts;
    const [column, row] = [dexel % columns, Math.floor(dexel / columns)];
    const local = new THREE.Vector3(...at).applyMatrix4(this.object.matrix.clone().invert());
    return this.inPath([first[0] + column * spacing[0], first[1] + row * spacing[1], local.z]);
  }

  setTime(time: number): void {
    this.timeline.goTo(time);
  }

  /** Around the blank, in the frame of the path. */
  bounds(): THREE.Box3 {
    const { first, spacing, columns, rows } = this.facts;
    const box = new THREE.Box3(
      new THREE.Vector3(first[0] - spacing[0] / 2, first[1] - spacing[1] / 2, this.zRange[0]),
      new THREE.Vector3(first[0] + (columns - 0.5) * spacing[0], first[1] + (rows - 0.5) * spacing[1], this.zRange[1]),
    );
    return box.applyMatrix4(this.object.matrix);
  }

  /** Brings what is seen up to date, as far as one update goes. Returns whether it has all been brought. */
  update(camera: THREE.Camera, pixelsPerMillimeter: number): boolean {
    const { spacing } = this.facts;
    const pixels = Math.min(...spacing) * pixelsPerMillimeter;
    const level = Math.min(Math.max(Math.floor(Math.log2(cellPixels / pixels)), 0), maxLevel);
    this.object.updateWorldMatrix(true, false);
    const frustum = new THREE.Frustum().setFromProjectionMatrix(
      new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).multiply(this.object.matrixWorld),
    );
    const box = new THREE.Box3();
    this.updateSection();
    this.lastUpdate = this.tiles.update({ level, isSeen: (tile) => frustum.intersectsBox(this.boxOf(tile, box)) });
    return !this.lastUpdate.isMore;
  }

  dispose(): void {
    for (const mesh of this.meshes.values()) mesh.geometry.dispose();
    this.faces.geometry.dispose();
    this.faces.material.dispose();
    this.material.dispose();
  }

  private inPath(at: Vector): Vector {
    return new THREE.Vector3(...at).applyMatrix4(this.object.matrix).toArray();
  }

  private paint(): SurfaceColors {
    const { bodies, bodyEdge } = palettes[this.theme];
    this.faces.material.color.setHex(number(mixed(bodies.stock, bodyEdge)));
    return stockColors(this.timeline, this.path, this.mode, this.theme, linear);
  }

  private repaint(): void {
    this.colors = this.paint();
    this.tiles.changeAll();
  }

  private updateSection(): void {
    const { section } = this;
    if (!section) return;
    const normal = new THREE.Vector3().setComponent(section.axis, section.keeps);
    // Clipping planes are those of the whole picture.
    this.plane.set(normal, -section.keeps * section.at).applyMatrix4(this.object.matrixWorld);
    if (!this.areFacesDue) return;
    this.areFacesDue = false;
    this.faces.geometry.dispose();
    this.faces.geometry = geometryOf(sectionFaces(this.timeline.dexels, this.facts, section));
  }

  private boxOf({ column, row }: Tile, box: THREE.Box3): THREE.Box3 {
    const { first, spacing } = this.facts;
    box.min.set(first[0] + (column * tileSize - 0.5) * spacing[0], first[1] + (row * tileSize - 0.5) * spacing[1], this.zRange[0]);
    box.max.set(box.min.x + tileSize * spacing[0], box.min.y + tileSize * spacing[1], this.zRange[1]);
    return box;
  }

  private draw(tile: Tile, surface: Surface): void {
    const old = this.meshes.get(tile);
    if (old) {
      this.object.remove(old);
      old.geometry.dispose();
      this.meshes.delete(tile);
    }
    if (surface.indices.length === 0) return;
    const mesh = new THREE.Mesh(geometryOf(surface), this.material);
    this.meshes.set(tile, mesh);
    this.object.add(mesh);
  }
}

function geometryOf({ positions, normals, colors, indices }: Surface): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new THREE.BufferAttribute(normals, 4, true));
  geometry.setAttribute('color', new THREE.BufferAttribute(colors, 4, true));
  geometry.setIndex(new THREE.BufferAttribute(indices, 1));
  return geometry;
}

/** As three.js takes the color of a corner. */
function linear(color: number): number {
  const { r, g, b } = new THREE.Color(color);
  return (Math.round(255 * r) << 16) | (Math.round(255 * g) << 8) | Math.round(255 * b);
}

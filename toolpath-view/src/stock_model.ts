/** The stock in the picture, cut up to the present moment. */
import * as THREE from 'three';
import { number, palettes, type Theme } from './colors';
import type { StockFacts } from './stock';
import type { Surface } from './stock_mesh';
import { maxLevel, SurfaceBuilder, tileSize, type SurfaceColors } from './stock_surface';
import { StockTiles, type Tile, type Update } from './stock_tiles';
import type { StockTimeline } from './stock_timeline';

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
  private readonly zRange: [number, number];

  constructor(
    readonly timeline: StockTimeline,
    theme: Theme,
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
    this.colors = plain(theme);
    timeline.onChange = (first, length) => this.tiles.change(first, length);
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
    this.colors = plain(theme);
    this.tiles.changeAll();
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
    this.lastUpdate = this.tiles.update({ level, isSeen: (tile) => frustum.intersectsBox(this.boxOf(tile, box)) });
    return !this.lastUpdate.isMore;
  }

  dispose(): void {
    for (const mesh of this.meshes.values()) mesh.geometry.dispose();
    this.material.dispose();
  }

  private boxOf({ column, row }: Tile, box: THREE.Box3): THREE.Box3 {
    const { first, spacing } = this.facts;
    box.min.set(first[0] + (column * tileSize - 0.5) * spacing[0], first[1] + (row * tileSize - 0.5) * spacing[1], this.zRange[0]);
    box.max.set(box.min.x + tileSize * spacing[0], box.min.y + tileSize * spacing[1], this.zRange[1]);
    return box;
  }

  private draw(tile: Tile, { positions, normals, colors, indices }: Surface): void {
    const old = this.meshes.get(tile);
    if (old) {
      this.object.remove(old);
      old.geometry.dispose();
      this.meshes.delete(tile);
    }
    if (indices.length === 0) return;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(normals, 4, true));
    geometry.setAttribute('color', new THREE.BufferAttribute(colors, 4, true));
    geometry.setIndex(new THREE.BufferAttribute(indices, 1));
    const mesh = new THREE.Mesh(geometry, this.material);
    this.meshes.set(tile, mesh);
    this.object.add(mesh);
  }
}

/** As three.js takes the color of a corner. */
export const linear = (color: number) => {
  const { r, g, b } = new THREE.Color(color);
  return (Math.round(255 * r) << 16) | (Math.round(255 * g) << 8) | Math.round(255 * b);
};

function plain(theme: Theme): SurfaceColors {
  const color = linear(number(palettes[theme].bodies.stock));
  return { top: () => color, wall: () => color, other: color };
}

/** What stands in the scene beside the path: the tool, frames, the travel of the machine, a grid. */
import * as THREE from 'three';
import { number, palettes, type Color, type Theme } from './colors';
import type { Tool, Toolpath, Vector } from './toolpath';

const { degToRad } = THREE.MathUtils;

/** Where a machine's file does not describe a tool: large enough to be seen, and drawn more translucent. */
const unknownLength = (sceneSize: number) => Math.max(60, 0.09 * sceneSize);

/** Its tip is at the origin, its axis along z. */
export class ToolModel {
  readonly object = new THREE.Group();
  /** From the tip to the spindle nose, mm. */
  length = 0;
  private readonly cutter = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshStandardMaterial({ roughness: 0.45, metalness: 0.4 }));
  private readonly holder = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshStandardMaterial({ roughness: 0.6, metalness: 0.3 }));
  private shape = '';

  constructor() {
    this.object.add(this.cutter, this.holder);
    this.object.renderOrder = 3;
  }

  /** From the tip to the spindle nose. `density` makes it more translucent. */
  dress(tool: Tool, theme: Theme, sceneSize: number, density = 1): void {
    const shape = JSON.stringify([tool, theme]);
    if (shape === this.shape) return;
    this.shape = shape;
    const length = (this.length = tool.length || unknownLength(sceneSize));
    const radius = tool.radius || length / 20;
    const free = Math.min(length * 0.6, Math.max(length - 40, 5 * radius));
    const holderRadius = Math.max(1.5 * radius, 0.16 * length);
    this.cutter.geometry.dispose();
    this.holder.geometry.dispose();
    this.cutter.geometry = upright(new THREE.CylinderGeometry(radius, radius, free, 32), free / 2);
    this.holder.geometry = upright(
      new THREE.CylinderGeometry(1.4 * holderRadius, holderRadius, length - free, 32),
      (free + length) / 2,
    );
    const { cutter, holder } = palettes[theme];
    const isKnown = tool.length !== null && tool.radius !== null;
    for (const [mesh, color, opacity] of [
      [this.cutter, cutter, isKnown ? 0.9 : 0.6],
      [this.holder, holder, isKnown ? 0.55 : 0.3],
    ] as const) {
      mesh.material.color.setHex(number(color));
      mesh.material.transparent = true;
      mesh.material.opacity = opacity * density;
    }
  }

  /** The axis from tip to spindle is Rz(C) Ry(B) ez (D28). */
  place(tip: THREE.Vector3, b: number, c: number): void {
    this.object.position.copy(tip);
    this.object.rotation.set(0, degToRad(b), degToRad(c), 'ZYX');
  }
}

/** What carries the tool: the spindle along its axis, and the fork that C alone turns. Of the size of common heads, since no
 * file gives theirs. */
export class HeadModel {
  readonly object = new THREE.Group();
  private readonly material = new THREE.MeshStandardMaterial({ roughness: 0.7, metalness: 0.2, transparent: true, opacity: 0.2 });
  private readonly spindle = new THREE.Mesh(upright(new THREE.CylinderGeometry(55, 40, spindleLength, 40), spindleLength / 2), this.material);
  private readonly fork = new THREE.Group();

  constructor() {
    this.material.depthWrite = false;
    for (const side of [-1, 1]) {
      const arm = new THREE.Mesh(new THREE.BoxGeometry(90, 22, 200).translate(0, 74 * side, 60), this.material);
      this.fork.add(arm);
    }
    this.fork.add(new THREE.Mesh(new THREE.BoxGeometry(120, 170, 40).translate(0, 0, 180), this.material));
    this.object.add(this.spindle, this.fork);
    this.object.renderOrder = 3;
  }

  /** `toolLength` from the tip to the nose. */
  place(tip: THREE.Vector3, b: number, c: number, toolLength: number, theme: Theme): void {
    this.material.color.setHex(number(palettes[theme].holder));
    this.spindle.rotation.set(0, degToRad(b), degToRad(c), 'ZYX');
    const axis = new THREE.Vector3(0, 0, 1).applyEuler(this.spindle.rotation);
    this.spindle.position.copy(tip).addScaledVector(axis, toolLength);
    this.fork.position.copy(tip).addScaledVector(axis, toolLength + 0.6 * spindleLength);
    this.fork.rotation.set(0, 0, degToRad(c));
  }
}

const spindleLength = 190;

function upright(geometry: THREE.BufferGeometry, height: number): THREE.BufferGeometry {
  return geometry.rotateX(Math.PI / 2).translate(0, 0, height);
}

function label(text: string, color: Color): THREE.Sprite {
  const size = 64;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = size;
  const context = canvas.getContext('2d')!;
  context.font = `600 ${0.7 * size}px system-ui, sans-serif`;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillStyle = `rgb(${color.join(' ')})`;
  context.fillText(text, size / 2, size / 2);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  return new THREE.Sprite(new THREE.SpriteMaterial({ map: texture, transparent: true, depthTest: false }));
}

/** Three axes with their letters, one unit long. */
function triad(origin: Vector, axes: Vector[], theme: Theme): THREE.Group {
  const group = new THREE.Group();
  axes.forEach((axis, i) => {
    const color = palettes[theme].axes[i];
    const direction = new THREE.Vector3(...axis);
    const shaft = new THREE.CylinderGeometry(0.025, 0.025, 0.85, 8).translate(0, 0.425, 0);
    const head = new THREE.ConeGeometry(0.075, 0.2, 12).translate(0, 0.9, 0);
    for (const geometry of [shaft, head]) {
      const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ color: number(color) }));
      mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), direction);
      group.add(mesh);
    }
    const letter = label('XYZ'[i], color);
    letter.position.copy(direction).multiplyScalar(1.25);
    letter.scale.setScalar(0.4);
    group.add(letter);
  });
  group.position.set(...origin);
  return group;
}

/** Frames keep their size on the screen. */
export function frames(path: Toolpath, theme: Theme): THREE.Group {
  const group = new THREE.Group();
  for (const { origin, i, j, k } of path.facts.frames) group.add(triad(origin, [i, j, k], theme));
  return group;
}

export interface Box {
  min: Vector;
  max: Vector;
}

/** Whether the machine's linear axes have ends. */
export const hasTravel = (path: Toolpath) => path.facts.travel.slice(0, 3).every(([min, max]) => min !== null && max !== null);

/** A box around where the tip of an upright tool can go; null where an axis has no end. */
export function travelBox(path: Toolpath): Box | null {
  if (!hasTravel(path)) return null;
  const linear = path.facts.travel.slice(0, 3);
  return { min: linear.map(([min]) => min) as Vector, max: linear.map(([, max]) => max) as Vector };
}

export function travel(path: Toolpath, theme: Theme): THREE.LineSegments | null {
  const box = travelBox(path);
  if (!box) return null;
  return edges(box, palettes[theme].travel);
}

export function stock(box: Box | null, theme: Theme): THREE.LineSegments | null {
  return box && edges(box, palettes[theme].neutral);
}

function edges({ min, max }: Box, color: Color): THREE.LineSegments {
  const size = new THREE.Vector3(...max).sub(new THREE.Vector3(...min));
  const geometry = new THREE.EdgesGeometry(new THREE.BoxGeometry(size.x, size.y, size.z));
  const lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: number(color) }));
  lines.position.set(...min).addScaledVector(size, 0.5);
  return lines;
}

/** The shortest length of 1, 2 or 5 and zeros that is not below the given one. */
export function roundLength(min: number): number {
  const power = 10 ** Math.floor(Math.log10(min));
  return [1, 2, 5, 10].map((digit) => digit * power).find((length) => length >= min * (1 - 1e-9))!;
}

/** Squares under the path, of about a twentieth of it. */
export function grid(min: THREE.Vector3, max: THREE.Vector3, theme: Theme): THREE.LineSegments {
  const cell = roundLength(Math.max(max.x - min.x, max.y - min.y, 20) / 20);
  const floor = (value: number) => Math.floor(value / cell - 1) * cell;
  const ceiling = (value: number) => Math.ceil(value / cell + 1) * cell;
  const places: number[] = [];
  const [x0, x1, y0, y1] = [floor(min.x), ceiling(max.x), floor(min.y), ceiling(max.y)];
  for (let i = 0; x0 + i * cell <= x1 + cell / 2; ++i) places.push(x0 + i * cell, y0, min.z, x0 + i * cell, y1, min.z);
  for (let i = 0; y0 + i * cell <= y1 + cell / 2; ++i) places.push(x0, y0 + i * cell, min.z, x1, y0 + i * cell, min.z);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(places, 3));
  const lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: number(palettes[theme].grid) }));
  lines.renderOrder = -1;
  lines.userData.cell = cell;
  return lines;
}

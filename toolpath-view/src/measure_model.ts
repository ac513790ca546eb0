/** A measurement in the picture: its places, the line between them, and the place that could be chosen next. */
import * as THREE from 'three';
import { number, palettes, type Theme } from './colors';
import type { Vector } from './toolpath';

export class MeasureModel {
  readonly object = new THREE.Group();
  private readonly texture = ringTexture();
  private readonly material = new THREE.SpriteMaterial({ map: this.texture, depthTest: false });
  private readonly dots = [0, 1, 2].map(() => new THREE.Sprite(this.material));
  private readonly line = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ depthTest: false, transparent: true }));

  constructor() {
    this.object.renderOrder = 5;
    this.line.frustumCulled = false;
    this.object.add(this.line, ...this.dots);
    this.show([], null);
  }

  setTheme(theme: Theme): void {
    this.material.color.setHex(number(palettes[theme].measure));
    this.line.material.color.setHex(number(palettes[theme].measure));
  }

  /** Between two places the straight line, and the way along X, Y and Z. */
  show(chosen: Vector[], next: Vector | null): void {
    const places = next ? [...chosen, next] : chosen;
    this.dots.forEach((dot, i) => {
      dot.visible = i < places.length;
      if (dot.visible) dot.position.set(...places[i]);
    });
    this.line.visible = places.length > 1;
    if (!this.line.visible) return;
    const [[x0, y0, z0], [x1, y1, z1]] = places;
    const corners = [x0, y0, z0, x1, y1, z1, x0, y0, z0, x1, y0, z0, x1, y0, z0, x1, y1, z0, x1, y1, z0, x1, y1, z1];
    this.line.geometry.setAttribute('position', new THREE.Float32BufferAttribute(corners, 3));
  }

  /** Keeps dots at their size on the screen. */
  scale(millimetersPerPixel: number): void {
    for (const dot of this.dots) dot.scale.setScalar(16 * millimetersPerPixel);
  }

  dispose(): void {
    this.line.geometry.dispose();
    this.line.material.dispose();
    this.material.dispose();
    this.texture.dispose();
  }
}

function ringTexture(): THREE.Texture {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const context = canvas.getContext('2d')!;
  context.fillStyle = context.strokeStyle = 'white';
  context.beginPath();
  context.arc(32, 32, 25, 0, 2 * Math.PI);
  context.lineWidth = 9;
  context.stroke();
  context.beginPath();
  context.arc(32, 32, 8, 0, 2 * Math.PI);
  context.fill();
  return new THREE.CanvasTexture(canvas);
}

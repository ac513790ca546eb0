/** The path as lines, rapids dashed and arcs thicker, drawn by one call however many there are: of a width in pixels, or, where they are
 * very many, as thin as can be, which takes a fraction of the time and is not seen among so many. */
import * as THREE from 'three';
import { Kind, type Toolpath } from './toolpath';
import type { Color } from './colors';

const vertexShader = /* glsl */ `
  in vec3 start;
  in vec3 end;
  in vec4 style;     // Color, and in w: 0 hidden, 0.5 dashed, 0.75 solid, 1 thick.
  in float run;      // Length since the start of the move, mm.
  uniform vec2 viewport;
  uniform float width;
  uniform float thickWidth;
  flat out vec4 lineStyle;
  flat out float pixels;
  flat out float millimeters;
  flat out float before;
  flat out float done;  // Part of the line that the tool has passed.
  flat out vec2 levels; // Heights of both ends.
  out vec2 local;       // Pixels along and across.
  uniform int reached;
  uniform float reachedPart;

  void main() {
    vec4 a = projectionMatrix * modelViewMatrix * vec4(start, 1.0);
    vec4 b = projectionMatrix * modelViewMatrix * vec4(end, 1.0);
    vec2 from = a.xy / a.w * viewport * 0.5;
    vec2 to = b.xy / b.w * viewport * 0.5;
    pixels = length(to - from);
    vec2 along = pixels > 1e-4 ? (to - from) / pixels : vec2(1.0, 0.0);
    float reach = (style.w > 0.9 ? thickWidth : width) * 0.5 + 1.0;
    local = vec2(position.x * pixels + (position.x * 2.0 - 1.0) * reach, position.y * reach);
    vec2 place = from + along * local.x + vec2(-along.y, along.x) * local.y;
    lineStyle = style;
    millimeters = distance(start, end);
    before = run;
    levels = vec2(start.z, end.z);
    done = gl_InstanceID < reached ? 1.0 : gl_InstanceID == reached ? reachedPart : 0.0;
    vec4 nearest = position.x < 0.5 ? a : b;
    gl_Position = style.w < 0.25 ? vec4(2.0, 2.0, 2.0, 1.0)
                                 : vec4(place / viewport * 2.0 * nearest.w, nearest.z, nearest.w);
  }`;

const fragmentShader = /* glsl */ `
  flat in vec4 lineStyle;
  flat in float pixels;
  flat in float millimeters;
  flat in float before;
  flat in float done;
  flat in vec2 levels;
  in vec2 local;
  uniform vec2 heights;  // Between which lines are shown.
  uniform float width;
  uniform float pixelRatio;
  uniform float pixelsPerMillimeter;
  uniform float opacity;
  uniform float aheadOpacity;
  uniform float dashedWidth;
  uniform float thickWidth;
  uniform float dotted;  // 1 where all lines are dotted.
  out vec4 color;

  void main() {
    bool dashed = lineStyle.w < 0.6;
    float beyond = max(max(-local.x, local.x - pixels), 0.0);
    float radius = (dashed ? dashedWidth : lineStyle.w > 0.9 ? thickWidth : width) * 0.5;
    float alpha = clamp(radius + 0.5 - length(vec2(beyond, local.y)), 0.0, 1.0);
    float part = clamp(local.x / max(pixels, 1e-4), 0.0, 1.0);
    float height = mix(levels.x, levels.y, part);
    if (height < heights.x || height > heights.y) discard;
    if (dashed) {
      float phase = fract((before + part * millimeters) * pixelsPerMillimeter / (9.0 * pixelRatio));
      if (phase > 0.6) discard;
    }
    if (dotted > 0.5 && fract((before + part * millimeters) * pixelsPerMillimeter / (4.5 * pixelRatio)) > 0.55) discard;
    alpha *= part <= done && done > 0.0 ? opacity : aheadOpacity;
    if (alpha < 0.02) discard;
    color = vec4(lineStyle.rgb, alpha);
  }`;

/** No height is beyond it, mm. */
const unlimited = 1e30;
/** Two triangles for each line. */
const corners = new Float32Array([0, -1, 0, 0, 1, 0, 1, -1, 0, 1, 1, 0]);
const triangles = [0, 2, 1, 1, 2, 3];
const maxWideLines = 100_000;

/** Without instances, which renderers in software draw one by one. A line has the style of the point where it ends. */
const thinVertexShader = /* glsl */ `
  in vec4 style;
  in float run;
  flat out vec4 lineStyle;
  flat out int point;
  out float way;
  out float height;

  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    height = position.z;
    lineStyle = style;
    point = gl_VertexID;
    way = run;
  }`;

const thinFragmentShader = /* glsl */ `
  flat in vec4 lineStyle;
  flat in int point;
  in float way;
  in float height;
  uniform vec2 heights;
  uniform float pixelRatio;
  uniform float pixelsPerMillimeter;
  uniform float opacity;
  uniform float aheadOpacity;
  uniform int reached;
  uniform float dotted;
  out vec4 color;

  void main() {
    if (lineStyle.w < 0.25 || height < heights.x || height > heights.y) discard;
    if (lineStyle.w < 0.6 && fract(way * pixelsPerMillimeter / (9.0 * pixelRatio)) > 0.6) discard;
    // Lines as thin as can be cannot be thicker: arcs have a gap now and then.
    if (lineStyle.w > 0.9 && fract(way * pixelsPerMillimeter / (14.0 * pixelRatio)) > 0.9) discard;
    if (dotted > 0.5 && fract(way * pixelsPerMillimeter / (4.5 * pixelRatio)) > 0.55) discard;
    float alpha = point <= reached + 1 ? opacity : aheadOpacity;
    if (alpha < 0.02) discard;
    color = vec4(lineStyle.rgb, alpha);
  }`;

/** Dashes go on from move to move; numbers of 32 bits tell them apart up to here, mm. */
const longestRun = 16384;

function wideGeometry(places: Float32Array, style: THREE.BufferAttribute, run: Float32Array): THREE.BufferGeometry {
  const geometry = new THREE.InstancedBufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(corners, 3));
  geometry.setIndex(triangles);
  // Each line starts where the one before ends: one buffer serves as both.
  const shared = new THREE.InstancedInterleavedBuffer(places, 3);
  geometry.setAttribute('start', new THREE.InterleavedBufferAttribute(shared, 3, 0));
  geometry.setAttribute('end', new THREE.InterleavedBufferAttribute(shared, 3, 3));
  geometry.setAttribute('style', style);
  geometry.setAttribute('run', new THREE.InstancedBufferAttribute(run, 1));
  geometry.instanceCount = run.length;
  return geometry;
}

function thinGeometry(places: Float32Array, style: THREE.BufferAttribute, run: Float32Array): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(places, 3));
  geometry.setAttribute('style', style);
  geometry.setAttribute('run', new THREE.BufferAttribute(run, 1));
  return geometry;
}

const weights: Record<number, number> = { [Kind.Rapid]: 128, [Kind.Feed]: 191, [Kind.Arc]: 255, [Kind.Wait]: 0 };

export class PathLines {
  readonly mesh: THREE.Mesh | THREE.Line;
  private readonly material: THREE.ShaderMaterial;
  private readonly style: THREE.BufferAttribute;
  /** Of the first line in `style`. */
  private readonly offset: number;

  /** Of the points from `first` to `last`, places from `center`. */
  constructor(
    private readonly path: Toolpath,
    private readonly center: THREE.Vector3,
    private readonly first = 0,
    private readonly last = path.pointCount - 1,
  ) {
    const count = last - first;
    const places = new Float32Array(3 * (count + 1));
    for (let i = 0; i <= count; ++i) {
      const at = 3 * (first + i);
      places[3 * i] = path.tips[at] - center.x;
      places[3 * i + 1] = path.tips[at + 1] - center.y;
      places[3 * i + 2] = path.tips[at + 2] - center.z;
    }
    const isThin = count > maxWideLines;
    // Per line; where thin, per point that a line leads to.
    const run = new Float32Array(isThin ? count + 1 : count);
    this.style = isThin
      ? new THREE.BufferAttribute(new Uint8Array(4 * (count + 1)), 4, true)
      : new THREE.InstancedBufferAttribute(new Uint8Array(4 * count), 4, true);
    this.offset = isThin ? 1 : 0;
    let way = 0;
    for (let i = 0; i < count; ++i) {
      const point = first + i + 1;
      if (!isThin && path.pointStep[point] !== path.pointStep[point - 1]) way = 0;
      run[i] = way;
      way += path.lengthTo(point);
      if (isThin) run[i + 1] = way %= longestRun;
    }
    const geometry = isThin ? thinGeometry(places, this.style, run) : wideGeometry(places, this.style, run);
    this.material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: isThin ? thinVertexShader : vertexShader,
      fragmentShader: isThin ? thinFragmentShader : fragmentShader,
      transparent: true,
      depthWrite: false, // Else the soft edge of a line would keep the next one from joining it.
      side: THREE.DoubleSide,
      uniforms: {
        viewport: { value: new THREE.Vector2(1, 1) },
        width: { value: 1.6 },
        dashedWidth: { value: 1.1 },
        thickWidth: { value: 2.6 },
        pixelRatio: { value: 1 },
        pixelsPerMillimeter: { value: 1 },
        reached: { value: 0x7fffffff },
        reachedPart: { value: 1 },
        opacity: { value: 1 },
        aheadOpacity: { value: 1 },
        dotted: { value: 0 },
        heights: { value: new THREE.Vector2(-unlimited, unlimited) },
      },
    });
    this.mesh = isThin ? new THREE.Line(geometry, this.material) : new THREE.Mesh(geometry, this.material);
    this.mesh.frustumCulled = false;
  }

  /** Steps that are not shown are hidden; standing still always is. Rapids are dashed, arcs thicker than lines. */
  paint(colorOf: (step: number) => Color, shows: (step: number) => boolean): void {
    const bytes = this.style.array as Uint8Array;
    let painted = -1;
    let color: Color = [0, 0, 0];
    let weight = 0;
    for (let i = this.offset, point = this.first + 1; point <= this.last; ++i, ++point) {
      const step = this.path.pointStep[point];
      // A program that has done nothing has points, but no step.
      if (step !== painted && step < this.path.stepCount) {
        painted = step;
        color = colorOf(step);
        weight = shows(step) ? weights[this.path.stepKind[step]] : 0;
      }
      bytes[4 * i] = color[0];
      bytes[4 * i + 1] = color[1];
      bytes[4 * i + 2] = color[2];
      bytes[4 * i + 3] = weight;
    }
    this.style.needsUpdate = true;
  }

  set(uniforms: Record<string, number>): void {
    for (const [name, value] of Object.entries(uniforms)) this.material.uniforms[name].value = value;
  }
  /** Shows what is at these heights of the machine alone. */
  keepHeights(min: number, max: number): void {
    const inShader = (height: number) => Math.min(Math.max(height - this.center.z, -unlimited), unlimited);
    // What lies at a limit is shown; single precision is not so exact.
    (this.material.uniforms.heights.value as THREE.Vector2).set(inShader(min - 1e-3), inShader(max + 1e-3));
  }
  set alwaysInFront(is: boolean) {
    this.material.depthTest = !is;
    this.mesh.renderOrder = is ? 2 : 1;
  }
  resize(width: number, height: number): void {
    (this.material.uniforms.viewport.value as THREE.Vector2).set(width, height);
  }
  dispose(): void {
    this.mesh.geometry.dispose();
    this.material.dispose();
  }
}

/** Distances between two places, and the places of a path that a measurement can start from. Machine frame, mm, degrees. */
import type { SceneBody } from './scene';
import { Kind, type Toolpath, type Vector } from './toolpath';

/** What a place is: the end of a move, the center of an arc, a corner or the center of a body's end; else anywhere on the path or on
 * a body or the stock, or the tip of the tool. */
export type SnapKind = 'end' | 'center' | 'corner' | 'axis' | 'path' | 'surface' | 'stock' | 'tip';

export interface Snap {
  at: Vector;
  kind: SnapKind;
  /** Of the path, or that has cut the stock; from 0. */
  line?: number;
  body?: SceneBody;
}

export interface Measurement {
  distance: number;
  /** From the first place to the second. */
  delta: Vector;
  /** From X towards Y, above -180 up to 180; null where the one is above the other. */
  angle: number | null;
}

/** Places nearer than this in X and Y are above each other. */
const sameXY = 1e-6;

export function measured(from: Vector, to: Vector): Measurement {
  const delta = to.map((value, i) => value - from[i]) as Vector;
  const isUpright = Math.hypot(delta[0], delta[1]) < sameXY;
  return {
    distance: Math.hypot(...delta),
    delta,
    angle: isUpright ? null : (Math.atan2(delta[1], delta[0]) * 180) / Math.PI,
  };
}

/** How far the points of an arc may be from one circle: corners are rounded, and points stand for the path. */
const roundWithin = 0.1;

/** The center of an arc of the path; of a helix upright to Z the one at the height of its end. Null where the step is no arc, or has too few points. */
export function arcCenter(path: Toolpath, step: number): Vector | null {
  if (path.stepKind[step] !== Kind.Arc) return null;
  const [first, last] = [path.stepStart[step], path.stepStart[step + 1]];
  if (last - first < 2) return null;
  const points = Array.from({ length: last - first + 1 }, (_, i) => path.tipOf(first + i));
  const flat = points.map(([x, y]): Vector => [x, y, points.at(-1)![2]]);
  return circleThrough(points) ?? circleThrough(flat);
}

/** The center of the circle on which all points are; null where there is none. */
function circleThrough(points: Vector[]): Vector | null {
  const pick = (part: number) => points[Math.round(part * (points.length - 1))];
  // Ends may be parts of rounded corners, and the ends of a full circle are one point.
  const [a, b, c] = points.length > 6 ? [pick(0.15), pick(0.5), pick(0.85)] : [pick(0), pick(1 / 3), pick(2 / 3)];
  const minus = (p: Vector, q: Vector): Vector => [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
  const dot = (p: Vector, q: Vector) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  const cross = (p: Vector, q: Vector): Vector => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
  const [u, v] = [minus(b, a), minus(c, a)];
  const normal = cross(u, v);
  const square = dot(normal, normal);
  if (square < 1e-9) return null;
  const [toB, toC] = [cross(v, normal), cross(normal, u)];
  const center = a.map((value, i) => value + (dot(u, u) * toB[i] + dot(v, v) * toC[i]) / (2 * square)) as Vector;
  const radius = Math.hypot(...minus(a, center));
  const isOn = (point: Vector) => Math.abs(Math.hypot(...minus(point, center)) - radius) <= roundWithin;
  // Of a helix no circle through three points holds the others, or it is askew.
  const isFlat = (point: Vector) => Math.abs(dot(minus(point, a), normal)) <= roundWithin * Math.sqrt(square);
  return points.every((point) => isOn(point) && isFlat(point)) ? center : null;
}

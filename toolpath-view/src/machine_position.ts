/** The body of isodap's event `isocnc/position`: where the machine is while a program runs. */
import type { Vector } from './toolpath';

export interface MachinePosition {
  /** From 0. */
  line: number;
  /** Of the tool tip; machine frame, mm. */
  tip: Vector;
  /** Degrees. */
  b: number;
  c: number;
  /** Since the start of the run. */
  seconds: number;
}

/** Null where the body is none. VS Code counts lines from 1 with debuggers. */
export function readPosition(body: unknown): MachinePosition | null {
  const { line, tip, time } = (body ?? {}) as { line?: unknown; tip?: Record<string, unknown>; time?: unknown };
  const values = ['x', 'y', 'z', 'b', 'c'].map((axis) => tip?.[axis]);
  const isNumber = (value: unknown): value is number => typeof value === 'number' && Number.isFinite(value);
  if (!isNumber(line) || !isNumber(time) || !values.every(isNumber)) return null;
  const [x, y, z, b, c] = values;
  return { line: line - 1, tip: [x, y, z], b, c, seconds: time };
}

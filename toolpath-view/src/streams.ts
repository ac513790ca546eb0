/** The streams of a toolpath as isols sends them: whole, or as they differ from those sent before. */
import type { Facts, Recording } from './toolpath';

export const streamNames = ['steps', 'points', 'turns'] as const;
export type StreamName = (typeof streamNames)[number];

/** Bytes in place of `removed` old ones at `start`; the whole stream without `start`. */
export interface Patch {
  start?: number;
  removed?: number;
  data: Uint8Array;
}

/** As JSON has it: base64. */
export type SentPatch = Omit<Patch, 'data'> & { data: string };

export interface SentToolpath extends Record<StreamName, SentPatch> {
  resultId: string;
  /** Of the document. */
  version: number;
  facts: Facts;
}

export type Patches = Record<StreamName, Patch>;

/** Throws where the patch is none of this stream. */
export function patched(old: Uint8Array | undefined, { start, removed = 0, data }: Patch): Uint8Array {
  if (start === undefined) return data;
  if (!old || start + removed > old.length) throw new RangeError('the patch is of another stream');
  const bytes = new Uint8Array(old.length - removed + data.length);
  bytes.set(old.subarray(0, start));
  bytes.set(data, start);
  bytes.set(old.subarray(start + removed), start + data.length);
  return bytes;
}

/** The recording after the patches. */
export function applied(old: Recording | null, facts: Facts, patches: Patches): Recording {
  const [steps, points, turns] = streamNames.map((name) => patched(old?.[name], patches[name]));
  return { facts, steps, points, turns };
}

/** The whole recording as patches of nothing. */
export function whole(recording: Recording): Patches {
  return { steps: { data: recording.steps }, points: { data: recording.points }, turns: { data: recording.turns } };
}

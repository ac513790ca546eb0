/** The streams of a toolpath as isols sends them: whole, or as they differ from those sent before. */
import type { Facts, Recording } from './toolpath';

/** Those that each path has. */
const pathStreams = ['steps', 'points', 'turns'] as const;
export const streamNames = [...pathStreams, 'cuts'] as const;
type PathStream = (typeof pathStreams)[number];

/** Bytes in place of `removed` old ones at `start`; the whole stream without `start`. */
export interface Patch {
  start?: number;
  removed?: number;
  data: Uint8Array;
}

/** As JSON has it: base64. */
export type SentPatch = Omit<Patch, 'data'> & { data: string };

export interface SentToolpath extends Record<PathStream, SentPatch> {
  /** Left out where no stock is cut. */
  cuts?: SentPatch;
  resultId: string;
  /** Of the document. */
  version: number;
  facts: Facts;
}

export type Patches = Record<PathStream, Patch> & { cuts?: Patch };

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
  const [steps, points, turns] = pathStreams.map((name) => patched(old?.[name], patches[name]));
  // A path that had no stock is one whose stream is empty.
  const cuts = patches.cuts && patched(old?.cuts ?? new Uint8Array(), patches.cuts);
  return { facts, steps, points, turns, ...(cuts && { cuts }) };
}

/** The whole recording as patches of nothing. */
export function whole({ steps, points, turns, cuts }: Recording): Patches {
  return { steps: { data: steps }, points: { data: points }, turns: { data: turns }, ...(cuts && { cuts: { data: cuts } }) };
}

/** The bytes of what has been sent. */
export function received(sent: SentToolpath, bytesOf: (base64: string) => Uint8Array): Patches {
  const bytes = (patch: SentPatch): Patch => ({ ...patch, data: bytesOf(patch.data) });
  return { steps: bytes(sent.steps), points: bytes(sent.points), turns: bytes(sent.turns), ...(sent.cuts && { cuts: bytes(sent.cuts) }) };
}

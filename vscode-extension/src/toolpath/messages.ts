/** What the toolpath's panel and its page say to each other. */
import type { ComparisonRecording } from '../../../toolpath-view/src/comparison';
import type { MachinePosition } from '../../../toolpath-view/src/machine_position';
import type { Facts, Recording, Vector } from '../../../toolpath-view/src/toolpath';
import type { Patches } from '../../../toolpath-view/src/streams';
import type { Lines } from '../operations/operations';

/** What the page takes to show the old program of a diff beside the new one (toolpath-view/README.md). */
export type Overlay = ComparisonRecording & { old: Recording };

export type ToPage =
  | {
      type: 'path';
      /** Its URI: another program is looked at anew, an edited one from where one has looked at it. */
      program: string;
      resultId: string;
      previousResultId: string | null;
      facts: Facts;
      patches: Patches;
      language: 'en' | 'it';
    }
  /** The old program of a diff, beside the path with this result; null where it is in no diff. */
  | { type: 'comparison'; resultId: string; overlay: Overlay | null }
  | { type: 'problem'; message: string }
  /** Lines that are selected in the editor, from 0; `last` belongs to them. */
  | { type: 'lines'; first: number; last: number }
  /** Lines whose path is not shown; instead of those before. */
  | { type: 'hide'; lines: Lines[] }
  | ({ type: 'pose' } & MachinePosition)
  /** Length, width, height. */
  | { type: 'stock'; size: Vector | null };

export type ToPanel =
  | { type: 'ready' }
  /** The page has not got what `previousResultId` names. */
  | { type: 'resend' }
  | { type: 'picked'; line: number }
  /** Somebody wants to keep a file; the name is one to begin with. */
  | { type: 'save'; name: string; content: Uint8Array }
  /** The tool has come to a line while the time runs. */
  | { type: 'passing'; line: number };

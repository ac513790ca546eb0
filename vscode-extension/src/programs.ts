/** The programs that the extension starts, and where they are. */
import { join } from 'node:path';

export type ProgramName = 'isols' | 'isolint' | 'isorun' | 'isofmt' | 'isodap';

export interface Places {
  /** The folder that the user names; empty is none. */
  configured: string;
  /** What comes with the extension. */
  bundled: string;
  /** Folders of the PATH. */
  path: string[];
}

/** The file of a program; null where there is none. What the user names is never passed over in silence. */
export function findProgram(
  name: ProgramName,
  { configured, bundled, path }: Places,
  exists: (file: string) => boolean,
  platform: string = process.platform,
): string | null {
  const file = platform === 'win32' ? `${name}.exe` : name;
  const folders = configured ? [configured] : [bundled, ...path];
  return folders.filter(Boolean).map((folder) => join(folder, file)).find(exists) ?? null;
}

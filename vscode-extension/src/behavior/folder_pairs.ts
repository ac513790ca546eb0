/** The programs of two folders side by side, by their paths in these. */

export type Pairing = 'changed' | 'onlyOld' | 'onlyNew';

export interface Pair {
  path: string;
  pairing: Pairing;
}

/** Those that are not the same in both, by path. The maps have a text that stands for the content. */
export function differingPairs(old: ReadonlyMap<string, string>, now: ReadonlyMap<string, string>): Pair[] {
  const paths = [...new Set([...old.keys(), ...now.keys()])].sort();
  const pairing = (path: string): Pairing => (!now.has(path) ? 'onlyOld' : !old.has(path) ? 'onlyNew' : 'changed');
  return paths.filter((path) => old.get(path) !== now.get(path)).map((path) => ({ path, pairing: pairing(path) }));
}

/** The program of this tab, which is there again when the page is loaded anew. It goes with the tab. */
const key = 'isocnc.program';

export interface NamedProgram {
  name: string;
  text: string;
}

/** `fragment` is that of the page's address. */
interface Kept extends NamedProgram {
  fragment: string;
}

/** A browser may keep nothing, or nothing of this size: then the page begins anew. */
export function keepProgram({ name, text }: NamedProgram): void {
  try {
    sessionStorage.setItem(key, JSON.stringify({ name, text, fragment: location.hash } satisfies Kept));
  } catch {
    forget();
  }
}

/** An older state of the program would be worse than none. */
function forget(): void {
  try {
    sessionStorage.removeItem(key);
  } catch {
    // There is nothing to forget.
  }
}

/** Null where none was kept, or where the address holds another one. */
export function keptProgram(): NamedProgram | null {
  try {
    const kept = JSON.parse(sessionStorage.getItem(key) ?? 'null') as Kept | null;
    return kept?.fragment === location.hash ? kept : null;
  } catch {
    return null;
  }
}

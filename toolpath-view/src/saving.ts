/** Files that somebody takes out of the page. */
import { element } from './elements';

/** As a browser does it; an editor that holds the page asks where to. */
export function download(name: string, content: Blob): void {
  const url = URL.createObjectURL(content);
  element('a', { href: url, download: name }).click();
  // The browser has begun to read by then.
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/** The name of a file that belongs to a program. */
export const nameBeside = (program: string, ending: string) => `${program.replace(/^.*[\\/]/, '').replace(/\.[^.]*$/, '') || 'isocnc'}.${ending}`;

/** Programs from files of the computer, and into them. */

export const largestFile = 8; // MB.

export class FileFailure extends Error {
  constructor(
    readonly failure: 'notText' | 'tooLarge',
    readonly file: string,
  ) {
    super(failure);
  }
}

/** The text of a file. Programs that are not UTF-8 are of old systems, with one byte for each letter. */
export async function textOf(file: File): Promise<string> {
  if (file.size > largestFile * 1e6) throw new FileFailure('tooLarge', file.name);
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (bytes.includes(0)) throw new FileFailure('notText', file.name);
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder('windows-1252').decode(bytes);
  }
}

export function save(name: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type: 'text/plain' }));
  const link = Object.assign(document.createElement('a'), { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** Calls `take` with each file that is dropped anywhere on the page; `dragging` says whether one is over it. */
export function acceptDrops(take: (file: File) => void, dragging: (is: boolean) => void): void {
  const hasFile = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
  const listen = (name: 'dragenter' | 'dragover' | 'dragleave' | 'drop', then: (event: DragEvent) => void) =>
    window.addEventListener(
      name,
      (event) => {
        if (!hasFile(event)) return;
        event.preventDefault();
        event.stopPropagation();
        then(event);
      },
      { capture: true },
    );
  listen('dragenter', () => dragging(true));
  listen('dragover', () => dragging(true));
  listen('dragleave', (event) => {
    if (event.relatedTarget === null) dragging(false);
  });
  listen('drop', (event) => {
    dragging(false);
    const file = event.dataTransfer?.files[0];
    if (file) take(file);
  });
}

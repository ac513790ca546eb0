/** Edits as the language server sends them, made in a text. */

export interface Place {
  line: number;
  character: number;
}

export interface TextEdit {
  range: { start: Place; end: Place };
  newText: string;
}

/** The text with these edits, which do not overlap. Lines end as the protocol says: \n, \r\n or \r. */
export function withEdits(text: string, edits: readonly TextEdit[]): string {
  const starts = [0, ...[...text.matchAll(/\r\n|\n|\r/g)].map((end) => end.index + end[0].length)];
  const offset = ({ line, character }: Place) => Math.min((starts[line] ?? text.length) + character, text.length);
  return edits
    .map(({ range, newText }) => ({ begin: offset(range.start), end: offset(range.end), newText }))
    .sort((a, b) => b.begin - a.begin || b.end - a.end)
    .reduce((changed, { begin, end, newText }) => changed.slice(0, begin) + newText + changed.slice(end), text);
}

/** What can be seen in a program's text without reading it as the server does. */

/** A line with blanks in place of its comments. */
export const code = (line: string) => line.replace(/\([^)]*\)?|;.*/g, (comment) => ' '.repeat(comment.length));

const toolChange = /m\s*0*6(?![\d\s]*\d)/i;

/** The line of the next tool change below or above a line; null where there is none. */
export function toolChangeBeside(
  lineCount: number,
  lineAt: (line: number) => string,
  from: number,
  direction: 1 | -1,
): number | null {
  for (let line = from + direction; line >= 0 && line < lineCount; line += direction)
    if (toolChange.test(code(lineAt(line)))) return line;
  return null;
}

export interface Expression {
  /** Column of the first character. */
  start: number;
  end: number;
  name: string;
}

const expressions = /v\s*g\s*p\s*l|v\s*\d+|[xyzbcfst](?=\s*[-+.\d])/gi;

/** What a debugger knows the value of, at a column: registers, axes, feed, speed, tool. */
export function expressionAt(line: string, column: number): Expression | null {
  const text = code(line);
  for (const found of text.matchAll(expressions)) {
    const number = /^\s*[-+]?[\d.\s]*/.exec(text.slice(found.index + found[0].length))![0].trimEnd();
    const end = found.index + found[0].length + (found[0].length === 1 ? number.length : 0);
    if (column >= found.index && column < Math.max(end, found.index + 1))
      return { start: found.index, end, name: found[0].replace(/\s/g, '').toUpperCase().replace(/^V0+(?=\d)/, 'V') };
  }
  return null;
}

/** The text of `isolint --explain` as elements: its paragraphs, which are wrapped at a width, and its programs, which are indented. */
import { element } from '../../../toolpath-view/src/elements';

const width = 78;
const indent = '    ';

/** Whether the next line goes on with a paragraph: its first word had no room on the line before. */
const continues = (line: string, next: string) => line.length + 1 + next.split(' ', 1)[0].length > width;

export function explanationParts(lines: readonly string[]): HTMLElement[] {
  const parts: HTMLElement[] = [];
  let program: string[] = [];
  let paragraph: string[] = [];
  const end = () => {
    if (paragraph.length > 0) parts.push(element('p', {}, paragraph.join(' ')));
    const text = program.join('\n').trimEnd();
    if (text) parts.push(element('pre', { tabIndex: 0 }, text));
    [program, paragraph] = [[], []];
  };
  for (const line of lines) {
    if (line.startsWith(indent)) {
      if (program.length === 0) end();
      program.push(line.slice(indent.length));
    } else if (line === '' && program.length > 0) {
      program.push('');
    } else {
      const last = paragraph.at(-1);
      if (program.length > 0 || (last !== undefined && !continues(last, line))) end();
      if (line !== '') paragraph.push(line);
    }
  }
  end();
  return parts;
}

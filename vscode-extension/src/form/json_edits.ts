/** Changes of a JSON text with comments, which stay where they are, as does the layout of all that does not change. */
import { findNodeAtLocation, parseTree, type Node } from 'jsonc-parser';
import type { Path } from './messages';

/** A piece of the text, and what takes its place. */
export interface Edit {
  offset: number;
  length: number;
  content: string;
}

/** A value as people write it on one line: `{"head": 1, "name": "ball 6"}`. */
export function inOneLine(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(inOneLine).join(', ')}]`;
  if (typeof value !== 'object' || value === null) return JSON.stringify(value);
  return `{${Object.entries(value).map(([key, each]) => `${JSON.stringify(key)}: ${inOneLine(each)}`).join(', ')}}`;
}

const end = (node: Node) => node.offset + node.length;

/** The end of the comments that stand on this line. */
function endOfComments(text: string, at: number): number {
  for (;;) {
    const comment = /^[ \t]*(\/\/[^\r\n]*|\/\*(?:(?!\*\/)[^\n])*\*\/)/.exec(text.slice(at));
    if (!comment) return at;
    at += comment[0].length;
  }
}

/** The comma behind a value, outside of comments; -1 for none. */
function commaBehind(text: string, at: number): number {
  const before = /^(?:\s|\/\/[^\r\n]*|\/\*[^]*?\*\/)*/.exec(text.slice(at))![0].length;
  return text[at + before] === ',' ? at + before : -1;
}

const lineStart = (text: string, at: number) => text.lastIndexOf('\n', at - 1) + 1;
const indentation = (text: string, at: number) => /^[ \t]*/.exec(text.slice(lineStart(text, at), at))![0];

/** Adds a part behind the last one of an object or a list, on a line of its own where the last one is on one. */
function added(text: string, container: Node, part: string): Edit[] {
  const lineEnd = text.includes('\r\n') ? '\r\n' : '\n';
  const last = container.children?.at(-1);
  const outer = indentation(text, container.offset);
  if (!last) {
    const bracket = end(container) - 1;
    const blank = text.slice(0, bracket).trimEnd().length; // A comment in the brackets stays before it.
    return [{ offset: blank, length: bracket - blank, content: `${lineEnd}${outer}  ${part}${lineEnd}${outer}` }];
  }
  const isOnLines = text.slice(container.offset, last.offset).includes('\n');
  if (!isOnLines) return [{ offset: end(last), length: 0, content: `, ${part}` }];
  const comments = endOfComments(text, end(last));
  const content = `${lineEnd}${indentation(text, last.offset)}${part}`;
  // A comment behind the last part belongs to it.
  return comments === end(last) ? [{ offset: comments, length: 0, content: `,${content}` }] : [{ offset: end(last), length: 0, content: ',' }, { offset: comments, length: 0, content }];
}

/** Removes a part of an object or a list, with the comment behind it. */
function removed(text: string, part: Node): Edit[] {
  const parts = part.parent!.children!;
  const place = parts.indexOf(part);
  const comma = commaBehind(text, end(part));
  let from = part.offset;
  let to = endOfComments(text, comma >= 0 ? comma + 1 : end(part));
  const isAlone = text.slice(lineStart(text, from), from).trim() === '' && /^[ \t]*(\r?\n|$)/.test(text.slice(to));
  if (isAlone && parts.length > 1) {
    from = lineStart(text, from);
    to += /^[ \t]*\r?\n?/.exec(text.slice(to))![0].length;
  } else if (comma >= 0) {
    to += /^[ \t]*/.exec(text.slice(to))![0].length;
  }
  const edits = [{ offset: from, length: to - from, content: '' }];
  if (place > 0 && place === parts.length - 1) {
    const before = commaBehind(text, end(parts[place - 1]));
    const isBeside = !isAlone && text.slice(before + 1, from).trim() === '';
    if (isBeside) edits[0] = { offset: before, length: to - before, content: '' };
    else edits.unshift({ offset: before, length: 1, content: '' });
  }
  return edits;
}

/** The edits, in the order of the text, after which the value at a path is this one; without a value it is not there. Empty where the text holds no object. */
export function editsFor(text: string, path: Path, value: unknown): Edit[] {
  const root = parseTree(text);
  if (root?.type !== 'object') return [];
  const node = findNodeAtLocation(root, path);
  if (node && value === undefined) return removed(text, node.parent?.type === 'property' ? node.parent : node);
  if (node) return [{ offset: node.offset, length: node.length, content: inOneLine(value) }];
  if (value === undefined) return [];
  // What is missing on the way is made.
  let depth = path.length - 1;
  let container = findNodeAtLocation(root, path.slice(0, depth));
  while (!container) container = findNodeAtLocation(root, path.slice(0, --depth));
  const inner = path.slice(depth + 1).reduceRight<unknown>((made, step) => (typeof step === 'number' ? [made] : { [step]: made }), value);
  const step = path[depth];
  return added(text, container, typeof step === 'number' ? inOneLine(inner) : `${JSON.stringify(step)}: ${inOneLine(inner)}`);
}

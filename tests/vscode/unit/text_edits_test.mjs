import assert from 'node:assert/strict';
import { test } from 'node:test';
import { module } from '../modules.mjs';

const { withEdits } = await module('text_edits');

const edit = (line, character, endLine, endCharacter, newText) => ({
  range: { start: { line, character }, end: { line: endLine, character: endCharacter } },
  newText,
});

for (const [name, text, edits, wanted] of [
  ['no edits', 'g00\n', [], 'g00\n'],
  ['several on a line, in any order', 'g00x1  y2\nm02', [edit(0, 5, 0, 7, ' '), edit(0, 0, 0, 3, 'G00 '), edit(1, 0, 1, 1, 'M')], 'G00 x1 y2\nM02'],
  ['all kinds of line ends', 'a\r\nb\rc\nd', [edit(1, 0, 1, 1, 'B'), edit(2, 0, 2, 1, 'C'), edit(3, 0, 3, 1, 'D')], 'a\r\nB\rC\nD'],
  ['an insertion before a replacement', 'x', [edit(0, 0, 0, 1, 'X'), edit(0, 0, 0, 0, 'G01 ')], 'G01 X'],
  ['a line that is removed', 'a\nb\nc', [edit(1, 0, 2, 0, '')], 'a\nc'],
  ['places beyond the end', 'a\nb', [edit(1, 1, 9, 0, '!')], 'a\nb!'],
])
  test(name, () => assert.equal(withEdits(text, edits), wanted));

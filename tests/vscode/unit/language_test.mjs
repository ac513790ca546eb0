// What package.json says of the language: which files are programs, what is a word, what isolint's lines look like.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { extension } from '../modules.mjs';

const { contributes } = JSON.parse(readFileSync(join(extension, 'package.json'), 'utf8'));
const configuration = JSON.parse(readFileSync(join(extension, 'language-configuration.json'), 'utf8'));
const firstLine = new RegExp(contributes.languages[0].firstLine);

for (const [line, is] of [
  ['N10 G17 G71 G90 G94', true],
  ['G71 G90', true],
  ['\ufeffG70', true],
  ['; part 12, ISOCNC', true],
  ['(isocnc program)', true],
  ['G92 X350 Y220 Z-185.5', true],
  ['M06 T101001', true],
  ['%', false],
  ['O1204 (FANUC)', false],
  ['G21 G54', false],
  ['M06 T12', false],
  ['Dear sirs,', false],
])
  test(`${line} ${is ? 'starts' : 'does not start'} a program`, () => assert.equal(firstLine.test(line), is));

test('a word is a letter with its number', () => {
  const word = new RegExp(configuration.wordPattern, 'g');
  assert.deepEqual('N10 G01X-12.5 GOTO N5 Y.5'.match(word), ['N10', 'G01', 'X-12.5', 'GOTO', 'N5', 'Y.5']);
});

const matched = (line) => {
  for (const { pattern, severity } of contributes.problemMatchers) {
    const { regexp, ...groups } = typeof pattern === 'string' ? contributes.problemPatterns.find(({ name }) => `$${name}` === pattern) : pattern;
    const found = new RegExp(regexp).exec(line);
    if (found) return Object.fromEntries([['severity', severity], ...Object.entries(groups).flatMap(([key, i]) => (typeof i === 'number' ? [[key, found[i]]] : []))]);
  }
  return null;
};

test('lines of isolint are read in both languages', () => {
  assert.deepEqual(matched('a b/part.iso:4:9: error: G40 must stand alone [ISO035]'), {
    severity: 'error', file: 'a b/part.iso', line: '4', column: '9', message: 'G40 must stand alone', code: 'ISO035',
  });
  for (const [word, severity] of [['errore', 'error'], ['avviso', 'warning'], ['nota', 'info']])
    assert.equal(matched(`C:\\parts\\a.iso:4:9: ${word}: testo [W101]`)?.severity, severity, word);
  assert.equal(matched('9 errors, 0 warnings in 1 file'), null);
});

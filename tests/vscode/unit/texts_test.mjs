// Whatever the user reads is there in both languages, and nothing that nobody reads.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { extension } from '../modules.mjs';

const json = (name) => JSON.parse(readFileSync(join(extension, name), 'utf8'));
const sorted = (values) => [...new Set(values)].sort();
const placeholders = (text) => sorted(text.match(/\{\d\}/g) ?? []);

const sources = readdirSync(join(extension, 'src'), { recursive: true })
  .filter((name) => name.endsWith('.ts'))
  .map((name) => readFileSync(join(extension, 'src', name), 'utf8'));

test('all that the extension says is in Italian, too', () => {
  const said = sources.flatMap((text) => [...text.matchAll(/l10n\.t\(\s*'((?:[^'\\]|\\.)*)'/g)].map(([, each]) => each.replaceAll("\\'", "'")));
  const calls = sources.reduce((sum, text) => sum + text.split('l10n.t(').length - 1, 0);
  assert.equal(said.length, calls, 'a text is not written where it is said');
  const italian = json('l10n/bundle.l10n.it.json');
  assert.deepEqual(sorted(Object.keys(italian)), sorted(said));
  for (const [text, translated] of Object.entries(italian)) assert.deepEqual(placeholders(translated), placeholders(text), text);
});

test('all that package.json says is in both languages', () => {
  const used = sorted([...readFileSync(join(extension, 'package.json'), 'utf8').matchAll(/%([\w.]+)%/g)].map(([, key]) => key));
  for (const name of ['package.nls.json', 'package.nls.it.json']) assert.deepEqual(sorted(Object.keys(json(name))), used, name);
});

test('pages of the walkthrough are in Italian, too', () => {
  const page = (name) => readFileSync(join(extension, name), 'utf8').split('\n');
  const pages = json('package.json').contributes.walkthroughs.flatMap(({ steps }) => steps.map(({ media }) => media.markdown)).filter(Boolean);
  assert.ok(pages.length > 0);
  for (const name of pages) {
    const english = page(name);
    const italian = page(name.replace(/\.md$/, '.nls.it.md'));
    assert.equal(italian.length, english.length, name);
    english.forEach((line, i) => line.includes('//') || assert.equal(italian[i], line, `${name}:${i + 1}`));
  }
});

test('the test drive is the same in both languages but for its comments', () => {
  const without = (name) => readFileSync(join(extension, name), 'utf8').replace(/^(;|\/\/).*$/gm, '$1');
  for (const [name, translation] of [['start-here.iso', 'start-here.it.iso'], ['isocnc.json', 'isocnc.it.json']])
    assert.equal(without(`l10n/${translation}`), without(`test-drive/${name}`));
});

test('each command that is offered is registered, and the other way around', () => {
  const offered = json('package.json').contributes.commands.map(({ command }) => command);
  const registered = sources.flatMap((text) => [
    ...[...text.matchAll(/register(?:TextEditor)?Command\(\s*'(isocnc\.\w+)'/g)].map(([, name]) => name),
    ...[...text.matchAll(/^ {2}register\('(\w+)'/gm)].map(([, name]) => `isocnc.${name}`),
  ]);
  assert.deepEqual(sorted(registered), sorted(offered));
});

test('no key is bound twice', () => {
  const keys = json('package.json').contributes.keybindings.map(({ key }) => key);
  assert.deepEqual(keys, [...new Set(keys)]);
});

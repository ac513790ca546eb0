// The form's fields, which the schema decides, and what it says of a value.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { module } from '../modules.mjs';

const { editsFor, inOneLine } = await module('form/json_edits');
const { beginning, fieldOf, mayBe, newTool, numberIn, titleOf } = await module('form/schema');
const schemas = ['json', 'it.json'].flatMap((ending) =>
  ['isocnc', 'isocnc-setup'].map((name) => JSON.parse(readFileSync(new URL(`../../../docs/${name}.schema.${ending}`, import.meta.url)))));

/** All parts of a schema with their keys. */
function* parts(schema, path = '') {
  yield [path, schema];
  for (const [key, each] of Object.entries(schema.properties ?? {})) yield* parts(each, `${path}/${key}`);
  for (const each of [schema.items, schema.additionalProperties].flat()) if (each && typeof each === 'object') yield* parts(each, `${path}/*`);
}

test('each key of machine, tools and setups has a field', () => {
  for (const schema of schemas) {
    const own = schema.properties.machine ? [schema.properties.machine, schema.properties.setups] : [schema];
    for (const [path, part] of own.flatMap((each) => [...parts(each)])) assert.notEqual(fieldOf(part), 'other', path);
  }
});

test('what is new begins with what it needs, and may be so', () => {
  const { machine, setups } = schemas[0].properties;
  assert.deepEqual(beginning(machine.properties.tools.items), { head: 1, holder: 1, tool: 1 });
  assert.deepEqual(beginning(machine.properties.holders.additionalProperties), [[1, 0, 0]]);
  assert.deepEqual(Object.keys(beginning(setups.items)), setups.items.required ?? []);
});

test('a new tool has a place of its own', () => {
  assert.deepEqual(newTool([]), { head: 1, holder: 1, tool: 1 });
  assert.deepEqual(newTool([{ head: 1, holder: 1, tool: 7 }, { head: 2, holder: 1, tool: 30 }, null]), { head: 1, holder: 1, tool: 8 });
});

test('parts are called by T, name or number', () => {
  assert.equal(titleOf({ head: 1, holder: 2, tool: 3, name: 'ball 6' }, 4), 'T102003 · ball 6');
  assert.equal(titleOf({ paths: ['door*.iso'] }, 0), 'door*.iso');
  assert.equal(titleOf({}, 4), '5');
  assert.equal(titleOf('x', 0), '1');
});

test('numbers have a point or a comma, and stay in their range', () => {
  assert.equal(numberIn(' 118,5 '), 118.5);
  assert.equal(numberIn(''), null);
  assert.ok(Number.isNaN(numberIn('long')));
  const length = { type: 'number', exclusiveMinimum: 0, maximum: 10000 };
  assert.deepEqual([-1, 0, 0.5, 10000, 10001, NaN].map((each) => mayBe(each, length)), [false, false, true, true, false, false]);
  assert.equal(mayBe(1.5, { type: 'integer' }), false);
});

/** The text after edits, which are in its order. */
function changed(text, path, value) {
  let result = '';
  let at = 0;
  for (const { offset, length, content } of editsFor(text, path, value)) {
    assert.ok(offset >= at);
    result += text.slice(at, offset) + content;
    at = offset + length;
  }
  return result + text.slice(at);
}

const shop = `{
  // ours
  "machine": {
    "axes": {"X": {"min": 0, "max": 3200}}, /* all */
    "tools": [
      {"head": 1, "length": 120}, // good, {not} a part
      // next
      {"head": 2} // bought, in May
    ] // tools
  }
}
`;

test('a change leaves comments and layout alone', () => {
  const after = (from, to) => shop.replace(from, to);
  assert.equal(changed(shop, ['machine', 'tools', 0, 'length'], 118.5), after('120', '118.5'));
  assert.equal(changed(shop, ['machine', 'tools', 1, 'name'], 'ball'), after('{"head": 2}', '{"head": 2, "name": "ball"}'));
  assert.equal(changed(shop, ['machine', 'tools', 2], { head: 3 }), after('{"head": 2} // bought, in May', '{"head": 2}, // bought, in May\n      {"head": 3}'));
  assert.equal(changed(shop, ['machine', 'axes', 'Y', 'min'], 5), after('3200}}', '3200}, "Y": {"min": 5}}'));
  assert.equal(changed(shop, ['machine', 'holders', 'ER'], [[1, 2, 3]]), after('] // tools', '], // tools\n    "holders": {"ER": [[1, 2, 3]]}'));
  assert.equal(changed(shop, ['setups', 0, 'paths'], ['a']), after('  }\n}\n', '  },\n  "setups": [{"paths": ["a"]}]\n}\n'));
  assert.equal(changed(shop, ['machine', 'tools', 0], undefined), after('      {"head": 1, "length": 120}, // good, {not} a part\n', ''));
  assert.equal(changed(shop, ['machine', 'tools', 1], undefined), after('120}, //', '120} //').replace('      {"head": 2} // bought, in May\n', ''));
  assert.equal(changed(shop, ['machine', 'tools', 0, 'length'], undefined), after(', "length": 120', ''));
  assert.equal(changed(shop, ['machine', 'axes', 'X', 'min'], undefined), after('"min": 0, ', ''));
  assert.equal(changed('{"a": [1]}', ['a', 0], undefined), '{"a": []}');
  assert.equal(changed('{\n}\n', ['a'], 1), '{\n  "a": 1\n}\n');
  assert.equal(changed('{"a": 1}', ['b'], undefined), '{"a": 1}');
  assert.equal(inOneLine({ a: [1, 'x', null], b: {} }), '{"a": [1, "x", null], "b": {}}');
});

test('whatever is set or removed, the text says it, and keeps its comments', () => {
  let seed = 7;
  const below = (size) => (seed = (seed * 48271) % 2147483647) % size;
  for (let round = 0; round < 300; ++round) {
    let text = shop;
    const value = JSON.parse(text.replaceAll(/\/\/.*|\/\*.*?\*\//g, ''));
    for (let step = 0; step < 8; ++step) {
      const { tools } = value.machine;
      const place = below(tools.length + 1);
      const isRemoved = place < tools.length && below(3) === 0;
      if (isRemoved) { text = changed(text, ['machine', 'tools', place], undefined); tools.splice(place, 1); continue; }
      const key = ['name', 'length', 'head'][below(3)];
      const given = below(4) === 0 ? undefined : below(100);
      if (place === tools.length) { text = changed(text, ['machine', 'tools', place], { [key]: 1 }); tools.push({ [key]: 1 }); continue; }
      text = changed(text, ['machine', 'tools', place, key], given);
      if (given === undefined) delete tools[place][key]; else tools[place][key] = given;
    }
    assert.deepEqual(JSON.parse(text.replaceAll(/\/\/.*|\/\*.*?\*\//g, '')), value, text);
    for (const comment of ['// ours', '/* all */', '// tools']) assert.ok(text.includes(comment), text);
  }
});

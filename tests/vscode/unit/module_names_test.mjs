import assert from 'node:assert/strict';
import { test } from 'node:test';
import { module } from '../modules.mjs';

const { fromModule, isComplete, messageFromModule, messageToModule, pathOf, placeOf, toModule, withPaths } = await module('module/names');

for (const [uri, inside] of [
  ['vscode-vfs://github/shop/parts/a%20b.iso', 'file:///@vscode-vfs/github/shop/parts/a%20b.iso'],
  ['workshop:/parts/a.iso', 'file:///@workshop/-/parts/a.iso'],
  ['vscode-remote://wsl%2Bdebian/home/a.iso', 'file:///@vscode-remote/wsl%2Bdebian/home/a.iso'],
])
  test(`${uri} has its own place in the module`, () => {
    assert.equal(toModule(uri), inside);
    assert.equal(fromModule(inside), uri);
    assert.equal(fromModule(inside.replace('@', '%40')), uri);
  });

test('files of this computer and texts without a file keep their names', () => {
  for (const uri of ['file:///parts/a.iso', 'file:///c%3A/parts/a.iso', 'untitled:Untitled-1', 'https://example.com/rules.html', 'git:/parts/a.iso?%7B%7D']) {
    assert.equal(toModule(uri), uri);
    assert.equal(fromModule(uri), uri);
  }
});

test('paths lead back to their places', () => {
  for (const place of [
    { scheme: 'file', authority: '', path: '/parts/a.iso' },
    { scheme: 'vscode-vfs', authority: 'github', path: '/shop/a.iso' },
    { scheme: 'workshop', authority: '', path: '/a b.iso' },
  ])
    assert.deepEqual(placeOf(pathOf(place)), place);
});

test('what a user names is complete or in the folder', () => {
  for (const name of ['/a.iso', 'c:\\a.iso', 'C:/a.iso', 'vscode-vfs://github/a.iso', 'workshop:/a.iso']) assert.ok(isComplete(name), name);
  for (const name of ['a.iso', 'parts/a.iso', '../a.iso', '-']) assert.ok(!isComplete(name), name);
});

const outside = 'workshop:/parts/a.iso';
const inside = 'file:///@workshop/-/parts/a.iso';

test('messages to the server have its names, and texts of programs stay', () => {
  const message = (uri) => ({ params: { rootUri: uri, textDocument: { uri, text: outside }, arguments: [{ uri, line: 3 }], data: [1, 2, 3] } });
  assert.deepEqual(messageToModule(message(outside)), message(inside));
});

test('messages of the server have the names of the editor', () => {
  const message = (uri) => ({
    result: { changes: { [uri]: [{ newText: 'G01' }] }, documentChanges: [{ kind: 'create', uri }], codeDescription: { href: 'https://example.com' }, data: [1, 2] },
  });
  assert.deepEqual(messageFromModule(message(inside)), message(outside));
});

test('paths of the debugger are changed wherever they stand', () => {
  const event = (path) => ({ body: { stackFrames: [{ line: 2, source: { name: 'a.iso', path } }], path: 5 } });
  assert.deepEqual(withPaths(event('/a'), (path) => `${path}.iso`), event('/a.iso'));
});

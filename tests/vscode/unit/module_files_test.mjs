// What the WebAssembly module gets of the files around a program, from a workspace that is played.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { module } from '../modules.mjs';

const vscode = `
  export class Uri {
    constructor(path) { Object.assign(this, { scheme: 'file', authority: '', path }); }
    static file(path) { return new Uri(path); }
    static from({ path }) { return new Uri(path); }
    static parse(text) { return new Uri(text.replace('file://', '')); }
    static joinPath({ path }, ...steps) { return new Uri(steps.reduce((at, step) => step === '..' ? at.slice(0, at.lastIndexOf('/')) : at + '/' + step, path)); }
    with({ path }) { return new Uri(path); }
    toString() { return 'file://' + this.path; }
  }
  export const FileType = { Unknown: 0, File: 1, Directory: 2, SymbolicLink: 64 };
  export class Disposable { static from(...all) { return { dispose() {} }; } }
  const typeOf = (path) => globalThis.links.has(path) ? 64 | (path in globalThis.files ? 1 : 2)
    : path in globalThis.files ? 1 : Object.keys(globalThis.files).some((each) => each.startsWith(path + '/')) ? 2 : 0;
  export const workspace = {
    textDocuments: [],
    workspaceFolders: [{ uri: new Uri('/shop') }],
    getWorkspaceFolder: () => ({ uri: new Uri('/shop') }),
    createFileSystemWatcher: () => ({ onDidCreate() {}, onDidDelete() {}, onDidChange: (look) => (globalThis.change = look), dispose() {} }),
    fs: {
      async readFile({ path }) {
        if (!(path in globalThis.files)) throw new Error(path);
        return new TextEncoder().encode(globalThis.files[path]);
      },
      async stat({ path }) {
        if (!typeOf(path)) throw new Error(path);
        return { type: typeOf(path), size: globalThis.sizes[path] ?? 1 };
      },
      async readDirectory({ path }) {
        const names = Object.keys(globalThis.files).filter((each) => each.startsWith(path + '/')).map((each) => each.slice(path.length + 1).split('/')[0]);
        return [...new Set(names)].map((name) => [name, typeOf(path + '/' + name)]);
      },
    },
  };`;

const { changed, configurationsAbove, filesOfArguments, filesOfFolder, setupBeside, watch } = await module('module/files', { vscode });
const { shapesIn, setupNameOf } = await module('module/named_files');

const uri = (path) => ({ scheme: 'file', authority: '', path, with: (other) => uri(other.path), toString: () => `file://${path}` });

function workspaceWith(files) {
  globalThis.files = files;
  globalThis.links = new Set();
  globalThis.sizes = {};
}

const shop = () => ({
  '/shop/isocnc.json': '{"setups": [{"paths": ["door.iso"], "fixtures": [{"mesh": "stl/clamp.stl"}]}]}',
  '/shop/parts/door.iso': 'M02',
  '/shop/parts/door.setup.json': '{"target": {"mesh": "door.stl"}}',
  '/shop/parts/door.stl': 'solid door',
  '/shop/parts/other.stl': 'solid other',
  '/shop/stl/clamp.stl': 'solid clamp',
});
const around = ['/shop/isocnc.json', '/shop/parts/door.iso', '/shop/parts/door.setup.json', '/shop/parts/door.stl', '/shop/stl/clamp.stl'];

test('a command that names a program gets its setup, and the meshes that configuration and setup name', async () => {
  workspaceWith(shop());
  const { files } = await filesOfArguments(['--verify', 'parts/door.iso'], '/shop', ['.iso']);
  assert.deepEqual(Object.keys(files).sort(), around);
  assert.equal(new TextDecoder().decode(files['/shop/parts/door.stl']), 'solid door');
});

test('an open program has them, too, and a folder those of all its programs', async () => {
  workspaceWith(shop());
  const open = { ...(await configurationsAbove(uri('/shop/parts/door.iso'))), ...(await setupBeside(uri('/shop/parts/door.iso'))) };
  assert.deepEqual(Object.keys(open).sort(), around.filter((path) => !path.endsWith('.iso')));
  assert.deepEqual(Object.keys(await setupBeside(uri('/shop/parts/window.iso'))), []);
  assert.deepEqual(Object.keys(await filesOfFolder(uri('/shop'), ['.iso'])).sort(), around);
});

test('a configuration of any name that a command names comes with its meshes', async () => {
  workspaceWith({ ...shop(), '/shop/mill.json': '{"machine": {"bodies": [{"mesh": "stl/clamp.stl"}]}}' });
  const { files } = await filesOfArguments(['--config', '/shop/mill.json'], '/shop', ['.iso']);
  assert.ok(files['/shop/stl/clamp.stl']);
});

test('a mesh outside the folder of its description is not read, nor one through a link, nor one that is too large', async () => {
  const contentOf = async (mesh) => {
    const others = await changed(uri('/shop/parts/door.setup.json'));
    delete others['/shop/parts/door.setup.json'];
    assert.ok(Object.keys(others).every((path) => path === mesh), Object.keys(others).join());
    return others[mesh] ?? null;
  };
  for (const name of ['../stl/clamp.stl', '/shop/stl/clamp.stl', 'a/../../stl/clamp.stl', 'inner/x.stl', '.', 'far.stl']) {
    workspaceWith({
      ...shop(),
      '/shop/parts/door.setup.json': JSON.stringify({ target: { mesh: name } }),
      '/shop/parts/inner/x.stl': 'solid x',
      '/shop/parts/far.stl': 'solid far',
    });
    globalThis.links.add('/shop/parts/inner');
    globalThis.sizes['/shop/parts/far.stl'] = (512 << 20) + 1;
    assert.equal(await contentOf(`/shop/parts/${name}`), null, name);
  }
  workspaceWith({ ...shop(), '/shop/parts/door.setup.json': '{"target": {"mesh": "a/../door.stl"}}' });
  assert.ok(await contentOf('/shop/parts/door.stl'));
});

test('a changed setup comes with the meshes that it names; of meshes only known ones are watched', async () => {
  workspaceWith(shop());
  const sent = [];
  watch(['.iso'], (path) => path === '/shop/parts/door.stl', (files) => sent.push(Object.keys(files)));
  for (const path of ['/shop/parts/door.setup.json', '/shop/parts/door.stl', '/shop/parts/other.stl', '/shop/notes.txt']) await globalThis.change(uri(path));
  assert.deepEqual(sent, [['/shop/parts/door.setup.json', '/shop/parts/door.stl'], ['/shop/parts/door.stl']]);
});

test('names of meshes and stocks are found in JSON with comments', () => {
  const text = '{"a": 1, // "mesh": "old.stl"\n "mesh" : "a\\u0020b/\\"c\\".stl", "fixtures": [{"mesh":"./d.stl"}, {"mesh": "./d.stl"}, {"mesh": 3}], "stock": {"from": "side1.stock"}}';
  assert.deepEqual(shapesIn(text), [['old.stl'], ['a b', '"c".stl'], ['d.stl'], ['side1.stock']]);
});

test('the setup of a program is named after it', () => {
  assert.equal(setupNameOf('door.iso'), 'door.setup.json');
  assert.equal(setupNameOf('door.v2.nc'), 'door.v2.setup.json');
  assert.equal(setupNameOf('door'), 'door.setup.json');
  assert.equal(setupNameOf('.iso'), '.iso.setup.json');
});

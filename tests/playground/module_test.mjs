// The WebAssembly module in Chromium says of all golden programs and examples what the programs for this machine say, to the byte.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, patience, printed, root, serve } from './browser.mjs';

const files = ['examples', 'tests/programs'].flatMap((folder) =>
  readdirSync(join(root, folder), { recursive: true })
    .filter((name) => name.endsWith('.iso'))
    .map((name) => `${folder}/${name}`)
    .sort(),
);

let browser;
let server;
let page;

before(async () => {
  [browser, server] = [await launch(), await serve()];
  page = await browser.newPage();
  page.setDefaultTimeout(patience);
  await page.goto(`${server.address}/`);
});
after(async () => {
  await browser?.close();
  server?.close();
});

test('commands in a worker print the same bytes', async () => {
  const programs = Object.fromEntries(files.map((file) => [`/${file}`, readFileSync(join(root, file)).toString('base64')]));
  await page.evaluate((sent) => {
    const bytes = (text) => Uint8Array.from(atob(text), (each) => each.charCodeAt(0));
    const worker = new Worker('/npm/dist/worker.js');
    worker.postMessage({ server: 'isols', wasm: '/npm/dist/isocnc.wasm' });
    worker.postMessage({ files: Object.fromEntries(Object.entries(sent).map(([path, text]) => [path, bytes(text)])) });
    globalThis.run = (program, args) =>
      new Promise((resolve, reject) => {
        worker.onmessage = ({ data }) => resolve(data);
        worker.onerror = ({ message }) => reject(new Error(message));
        worker.postMessage({ run: 1, program, args });
      });
  }, programs);
  for (const [program, ...args] of [
    ['isolint', '--no-config', '--select', 'ALL', '--format', 'json', '--lang', 'en'],
    ['isolint', '--no-config', '--select', 'ALL', '--lang', 'it'],
    ['isofmt', '--no-config', '--diff', '--lang', 'en'],
  ]) {
    const all = [...args, ...files];
    const { output } = await page.evaluate(([name, list]) => globalThis.run(name, list), [program, all]);
    const expected = printed(program, all);
    assert.ok(expected.length > 10_000, `${program}: ${expected.length}`);
    assert.ok(output === expected, `${program} ${args.join(' ')}: ${output.length} bytes there, ${expected.length} here`);
  }
});

test('check() of the npm package finds the same in each program', async () => {
  // It takes texts: a program of other bytes is none.
  const texts = files.map((file) => [file, readFileSync(join(root, file))]).filter(([, bytes]) => Buffer.from(bytes.toString('utf8')).equals(bytes));
  assert.ok(texts.length > 100, `${texts.length} programs`);
  const found = await page.evaluate(async (programs) => {
    const { check } = await import('/npm/dist/index.js');
    const all = [];
    for (const [filename, text] of programs) all.push(await check(text, { filename }));
    return all.map((findings) => JSON.stringify(findings));
  }, texts.map(([file, bytes]) => [file, bytes.toString('utf8')]));
  const expected = JSON.parse(printed('isolint', ['--no-config', '--lang', 'en', '--format', 'json', ...texts.map(([file]) => file)]));
  assert.ok(expected.length > 500, `${expected.length} findings`);
  texts.forEach(([file], i) => assert.equal(found[i], JSON.stringify(expected.filter((each) => each.file === file)), file));
});

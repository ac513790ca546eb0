import assert from 'node:assert/strict';
import { mkdtempSync, readdirSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import test from 'node:test';
import { Client, isolint, root, uriOf } from './client.mjs';

const severities = ['error', 'warning', 'info'];

/** A diagnostic in isolint's words: its columns count in code points. */
const fromServer = (diagnostic) => ({
  line: diagnostic.range.start.line + 1,
  column: diagnostic.range.start.character + 1,
  code: diagnostic.code,
  severity: severities[diagnostic.severity - 1],
  message: diagnostic.message,
});
const fromIsolint = ({ line, column, code, severity, message }) => ({ line, column, code, severity, message });

const examples = ['examples', 'examples/broken', 'examples/machine']
  .flatMap((folder) => readdirSync(path.join(root, folder)).map((name) => path.join(root, folder, name)))
  .filter((file) => file.endsWith('.iso'));

test('the Problems list says of every example what isolint says', async () => {
  const client = await Client.start({ general: { positionEncodings: ['utf-32'] } });
  assert.equal(client.initialized.capabilities.positionEncoding, 'utf-32');
  for (const file of examples) {
    const found = await client.diagnostics(client.openFile(file));
    assert.deepEqual(found.map(fromServer), isolint(file).map(fromIsolint), file);
  }
  assert.equal(await client.stop(), 0);
});

test('pulled findings are those that are pushed, and have a result id', async () => {
  const file = path.join(root, 'examples/broken/option.iso');
  const pusher = await Client.start();
  const pushed = await pusher.diagnostics(pusher.openFile(file));
  await pusher.stop();
  const client = await Client.start({ textDocument: { diagnostic: {} } });
  const uri = client.openFile(file);
  const textDocument = { uri };
  const full = await client.request('textDocument/diagnostic', { textDocument });
  assert.equal(full.kind, 'full');
  assert.deepEqual(full.items, pushed);
  const again = await client.request('textDocument/diagnostic', { textDocument, previousResultId: full.resultId });
  assert.deepEqual(again, { kind: 'unchanged', resultId: full.resultId });
  client.change(uri, 2, { range: { start: { line: 0, character: 0 }, end: { line: 0, character: 0 } }, text: 'G80\n' });
  const changed = await client.request('textDocument/diagnostic', { textDocument, previousResultId: full.resultId });
  assert.equal(changed.items.length, full.items.length + 1);
  assert.equal(await client.stop(), 0);
});

test('the jump that leads to a finding is its related information', async () => {
  const client = await Client.start({ textDocument: { publishDiagnostics: { relatedInformation: true } } });
  const file = path.join(root, 'examples/broken/option.iso');
  const found = await client.diagnostics(client.openFile(file));
  const reached = isolint(file).filter(({ path: steps }) => steps !== null);
  assert.ok(reached.length > 0);
  assert.deepEqual(
    found
      .filter(({ relatedInformation }) => relatedInformation)
      .map(({ relatedInformation }) =>
        relatedInformation.map(({ location, message }) => ({ line: location.range.start.line + 1, text: message }))),
    reached.map(({ path: steps }) => steps),
  );
  assert.equal(await client.stop(), 0);
});

test('the configuration beside a program counts, and its changes', async () => {
  const folder = mkdtempSync(path.join(os.tmpdir(), 'isols-'));
  const file = path.join(folder, 'part.iso');
  const configuration = path.join(folder, 'isocnc.json');
  writeFileSync(file, 'M06 T101001\nG01 X10\nM02\n');
  writeFileSync(configuration, '{"lint": {"ignore": ["ISO066"]}, "language": "it"}');
  const client = await Client.start({ workspace: { didChangeWatchedFiles: { dynamicRegistration: true } } });
  const uri = client.openFile(file);
  assert.deepEqual(await client.diagnostics(uri), []);
  assert.equal(client.registrations[0].method, 'workspace/didChangeWatchedFiles');
  writeFileSync(configuration, '{}');
  client.notify('workspace/didChangeWatchedFiles', { changes: [{ uri: uriOf(configuration), type: 2 }] });
  client.change(uri, 2, { range: { start: { line: 2, character: 3 }, end: { line: 2, character: 3 } }, text: ' ' });
  assert.deepEqual((await client.diagnostics(uri, 2)).map(({ code }) => code), ['ISO066']);
  assert.equal(await client.stop(), 0);
});

test('mistakes in the configuration are reported in place, saved or not', async () => {
  const folder = mkdtempSync(path.join(os.tmpdir(), 'isols-'));
  const configuration = path.join(folder, 'isocnc.json');
  const program = path.join(folder, 'part.iso');
  writeFileSync(program, 'M02\n');
  writeFileSync(configuration, '{\n  /* \u20ac */ "lint": {"ignore": ["ISO999"]}\n}\n');
  const client = await Client.start();
  client.openFile(program);
  const [mistake] = await client.diagnostics(uriOf(configuration));
  assert.match(mistake.message, /lint\.ignore.*ISO999/);
  assert.deepEqual(mistake.range, { start: { line: 1, character: 30 }, end: { line: 1, character: 38 } });
  const uri = client.openFile(configuration);
  client.change(uri, 2, { text: '{"machin": {}}' });
  client.change(uri, 3, { text: '{}' });
  client.change(uri, 4, { text: '{"machin": {}}' });
  let found = [];
  while (found.length !== 1 || !/machin/.test(found[0].message)) {
    await new Promise((resolve) => setTimeout(resolve, 10));
    found = await client.diagnostics(uri);
  }
  assert.match(found[0].message, /did you mean machine/);
  assert.equal(await client.stop(), 0);
});

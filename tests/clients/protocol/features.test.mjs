import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import { ShowDocumentRequest, TextDocumentContentRefreshRequest, TextDocumentContentRequest } from 'vscode-languageserver-protocol';
import { Client, isolint, root } from './client.mjs';

const file = path.join(root, 'examples/broken/option.iso');
const text = readFileSync(file, 'utf8');
const jump = text.split('\n').findIndex((line) => line.includes('GOTO N300'));
const label = text.split('\n').findIndex((line) => line.startsWith('N300 '));

/** The text with edits made as an editor makes them, from the last to the first. */
function edited(before, edits) {
  const starts = [0];
  for (let at = before.indexOf('\n'); at >= 0; at = before.indexOf('\n', at + 1)) starts.push(at + 1);
  const offset = ({ line, character }) => starts[line] + character;
  return edits
    .toSorted((a, b) => offset(b.range.start) - offset(a.range.start))
    .reduce((all, { range, newText }) => all.slice(0, offset(range.start)) + newText + all.slice(offset(range.end)), before);
}

async function opened(capabilities) {
  const client = await Client.start(capabilities);
  const uri = client.openFile(file);
  return { client, uri, target: { textDocument: { uri }, position: { line: jump, character: text.split('\n')[jump].length } } };
}

test('a jump is explained, followed and renamed with its label', async () => {
  const { client, uri, target } = await opened();
  const place = { ...target, position: { ...target.position, character: target.position.character - 1 } };
  const hover = await client.request('textDocument/hover', place);
  assert.match(hover.contents.value, /\*\*N300\*\* target of a jump/);
  const [found, ...others] = await client.request('textDocument/definition', place);
  assert.deepEqual(others, []);
  assert.deepEqual([found.uri, found.range.start], [uri, { line: label, character: 0 }]);
  const references = await client.request('textDocument/references', { ...place, context: { includeDeclaration: true } });
  assert.deepEqual(references.map(({ range }) => range.start.line), [jump, label]);
  const prepared = await client.request('textDocument/prepareRename', place);
  assert.equal((prepared.range ?? prepared).start.line, jump);
  const { changes } = await client.request('textDocument/rename', { ...place, newName: 'N305' });
  const renamed = edited(text, changes[uri]).split('\n');
  assert.ok(renamed[jump].endsWith('GOTO N305'));
  assert.ok(renamed[label].startsWith('N305 '));
  await assert.rejects(client.request('textDocument/rename', { ...place, newName: 'N10' }), { code: -32803 });
  assert.equal(await client.stop(), 0);
});

test('a finding is fixed, and is gone then', async () => {
  const { client, uri } = await opened();
  const before = await client.diagnostics(uri);
  const finding = before.find(({ code }) => code === 'ISO043');
  const actions = await client.request('textDocument/codeAction', {
    textDocument: { uri },
    range: finding.range,
    context: { diagnostics: [finding], only: ['quickfix'] },
  });
  const fix = actions.find(({ isPreferred }) => isPreferred);
  assert.match(fix.title, /put M02 on a line of its own/);
  client.change(uri, 2, { text: edited(text, fix.edit.changes[uri]) });
  const after = await client.diagnostics(uri, 2);
  assert.equal(after.length, before.length - 1);
  assert.ok(!after.some(({ code }) => code === 'ISO043'));
  assert.equal(await client.stop(), 0);
});

test('a program is formatted, and says the same then', async () => {
  const { client, uri } = await opened();
  const codes = isolint(file).map(({ code }) => code);
  client.change(uri, 2, { text: text.toLowerCase() });
  const options = { tabSize: 2, insertSpaces: true };
  const edits = await client.request('textDocument/formatting', { textDocument: { uri }, options });
  const formatted = edited(text.toLowerCase(), edits);
  assert.ok(formatted.includes('GOTO N300'));
  client.change(uri, 3, { text: formatted });
  assert.deepEqual((await client.diagnostics(uri, 3)).map(({ code }) => code), codes);
  assert.deepEqual(await client.request('textDocument/formatting', { textDocument: { uri }, options }), []);
  assert.equal(await client.stop(), 0);
});

test('what else an editor shows of a program', async () => {
  const { client, uri, target } = await opened({
    textDocument: { documentSymbol: { hierarchicalDocumentSymbolSupport: true } },
  });
  const textDocument = { uri };
  const symbols = await client.request('textDocument/documentSymbol', { textDocument });
  assert.ok(symbols.some(({ name }) => /^T\d{6}/.test(name)), JSON.stringify(symbols));
  const completion = await client.request('textDocument/completion', target);
  assert.ok(completion.items.some((item) => item.label === 'N300'), JSON.stringify(completion));
  const folds = await client.request('textDocument/foldingRange', { textDocument });
  assert.ok(folds.some(({ startLine, endLine }) => startLine === jump && endLine === label - 1));
  const { data } = await client.request('textDocument/semanticTokens/full', { textDocument });
  assert.equal(data.length % 5, 0);
  assert.ok(data.length > 0);
  assert.equal(await client.stop(), 0);
});

test('the state and the syntax of a line are documents of the server', async () => {
  const { client, uri } = await opened({ workspace: { textDocumentContent: {} }, window: { showDocument: { support: true } } });
  const [scheme] = client.initialized.capabilities.workspace.textDocumentContent.schemes;
  const shown = new Promise((resolve) => {
    client.connection.onRequest(ShowDocumentRequest.type, (params) => {
      resolve(params.uri);
      return { success: true };
    });
  });
  const refreshed = new Promise((resolve) => {
    client.connection.onRequest(TextDocumentContentRefreshRequest.type, (params) => resolve(params.uri));
  });
  await client.request('workspace/executeCommand', { command: 'isocnc.showText', arguments: [{ uri, line: jump, text: 'state' }] });
  const place = await shown;
  assert.ok(place.startsWith(`${scheme}://state/option.iso.state?`));
  const content = () => client.connection.sendRequest(TextDocumentContentRequest.type, { uri: place });
  assert.match((await content()).text, new RegExp(`^option\\.iso:${jump + 1} .*GOTO N300\n`));
  client.change(uri, 2, { range: { start: { line: 0, character: 0 }, end: { line: 0, character: 0 } }, text: '\n' });
  assert.equal(await refreshed, place);
  assert.doesNotMatch((await content()).text, /GOTO/);
  assert.equal(await client.stop(), 0);
});

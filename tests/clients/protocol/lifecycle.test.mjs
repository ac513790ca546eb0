import assert from 'node:assert/strict';
import test from 'node:test';
import { Client } from './client.mjs';

test('exit without shutdown, and a client that dies, end the server with 1', async () => {
  const hasty = await Client.start();
  hasty.notify('exit');
  assert.equal(await hasty.exit, 1);
  const dying = await Client.start();
  await assert.rejects(dying.request('no/such', {}), { code: -32601 });
  dying.process.stdin.destroy();
  assert.equal(await dying.exit, 1);
});

// Where the page holds the server, it is the page that frames messages.
test('what is no message is answered, and the next one understood', { skip: process.env.ISOCNC_HOSTED }, async () => {
  const client = await Client.start();
  const errors = [];
  client.connection.onError(([error]) => errors.push(error.message));
  client.process.stdin.write('Content-Length: 1\r\n\r\n{');
  client.process.stdin.write('Content-Length: nonsense\r\n\r\n');
  await assert.rejects(client.request('no/such', {}), { code: -32601 });
  assert.equal(await client.stop(), 0);
});

test('a request for a document that is not open is refused', async () => {
  const client = await Client.start();
  const params = { textDocument: { uri: 'file:///no.iso' }, position: { line: 0, character: 0 } };
  await assert.rejects(client.request('textDocument/hover', params), { code: -32602 });
  assert.equal(await client.stop(), 0);
});

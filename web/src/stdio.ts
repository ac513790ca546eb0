/** A server of the module at standard input and output, as isols and isodap are: for the tests of both. */
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { Conversation } from './conversation';
import type { MakeModule, Server } from './module';

const [server, dist] = process.argv.slice(2) as [Server, string];
const makeModule = createRequire(import.meta.url)(`${dist}/isocnc-node.cjs`) as MakeModule;
const module = await makeModule({
  wasmBinary: readFileSync(`${dist}/isocnc.wasm`),
  preRun: [(starting) => void Object.assign(starting.ENV, process.env)],
});
const conversation = new Conversation(
  module,
  server,
  '',
  (body) => process.stdout.write(`Content-Length: ${Buffer.byteLength(body)}\r\n\r\n${body}`),
  (status) => process.stdout.write('', () => process.exit(status)),
);

let received = Buffer.alloc(0);
process.stdin.on('data', (bytes: Buffer) => {
  received = Buffer.concat([received, bytes]);
  for (;;) {
    const end = received.indexOf('\r\n\r\n');
    const length = /content-length: *(\d+)/i.exec(received.toString('latin1', 0, Math.max(end, 0)))?.[1];
    if (end < 0 || length === undefined || received.length < end + 4 + Number(length)) return;
    conversation.send(received.toString('utf8', end + 4, end + 4 + Number(length)));
    received = received.subarray(end + 4 + Number(length));
  }
});
process.stdin.on('end', () => process.exit(1));

// Language servers that are started and ended, with a client that is played.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setImmediate as turn } from 'node:timers/promises';
import { module } from '../modules.mjs';

const { Server } = await module('server', {
  vscode: `
    const nothing = () => {};
    const disposable = { dispose: nothing };
    export const env = { language: 'en' };
    export const l10n = { t: (text) => text };
    export const window = {
      createOutputChannel: () => ({ info: nothing, warn: nothing, error: nothing, ...disposable }),
      showErrorMessage: async () => undefined,
    };
    export const workspace = { onDidChangeConfiguration: () => disposable, getConfiguration: () => ({ get: (name, other) => other }) };
    export class EventEmitter {
      event = () => disposable;
      fire() {}
      dispose() {}
    }`,
  'vscode-languageclient': 'export const State = { Stopped: 1, Running: 2, Starting: 3 };',
});
const [stopped, running, starting] = [1, 2, 3];

class Client {
  state = stopped;
  constructor() {
    globalThis.clients.push(this);
  }
  registerFeature() {}
  onDidChangeState() {}
  start() {
    this.state = starting;
    return new Promise((done) => (this.answer = () => done((this.state = running))));
  }
  async dispose() {
    if (this.state === starting) throw new Error('it is starting');
    await new Promise(setImmediate);
    this.state = stopped;
  }
}

const made = () => {
  globalThis.clients = [];
  return new Server({ version: '0.1.0', find: () => ({ place: '/bin/isols', connect: () => new Client() }) });
};
const states = () => globalThis.clients.map(({ state }) => state);
/** All that are starting answer. */
async function settle() {
  for (let i = 0; i < 5; i++) {
    await turn();
    for (const client of globalThis.clients) if (client.state === starting) client.answer();
  }
}

test('of several restarts in a row one server comes', async () => {
  const server = made();
  void server.start();
  await settle();
  for (let i = 0; i < 3; i++) void server.restart();
  await settle();
  assert.deepEqual(states(), [stopped, running]);
});

test('a server that is given up while it starts is ended when it has', async () => {
  const server = made();
  void server.start();
  await turn();
  void server.restart();
  await turn();
  assert.deepEqual(states(), [starting, starting]);
  await settle();
  assert.deepEqual(states(), [stopped, running]);
});

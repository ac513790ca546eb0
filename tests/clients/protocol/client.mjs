// A typed client of the protocol, Microsoft's own, speaking with isols.
import { spawn, spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { after } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import {
  createProtocolConnection,
  StreamMessageReader,
  StreamMessageWriter,
  PublishDiagnosticsNotification,
} from 'vscode-languageserver-protocol/node';

export const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../../..');
const programs = process.env.ISOCNC_BIN_DIR ?? path.join(root, 'build/release/bin');

// Under Wine, the programs for Windows know our files on a drive: `/z%3A`.
export const uriOf = (file) => pathToFileURL(file).href.replace('file://', `file://${process.env.ISOCNC_DRIVE ?? ''}`);

/** What isolint says of a file: its JSON. */
export function isolint(file, ...options) {
  const run = spawnSync(path.join(programs, 'isolint'), ['--format', 'json', '--lang', 'en', ...options, file], {
    encoding: 'utf8',
    maxBuffer: 1 << 28,
  });
  return JSON.parse(run.stdout);
}

/** What a test that fails leaves behind would keep the run from its end. */
const processes = [];
after(() => processes.forEach((process) => process.kill('SIGKILL')));

export class Client {
  #published = new Map();
  #waiting = [];

  static async start(capabilities = {}, more = {}) {
    const client = new Client();
    client.process = spawn(path.join(programs, 'isols'), ['--stdio', '--lang', 'en'], {
      stdio: ['pipe', 'pipe', 'inherit'],
    });
    processes.push(client.process);
    client.exit = new Promise((resolve) => client.process.on('exit', (code, signal) => resolve(code ?? signal)));
    client.connection = createProtocolConnection(
      new StreamMessageReader(client.process.stdout),
      new StreamMessageWriter(client.process.stdin),
    );
    client.connection.onNotification(PublishDiagnosticsNotification.type, (params) => client.#take(params));
    client.registrations = [];
    client.connection.onRequest('client/registerCapability', (params) => {
      client.registrations.push(...params.registrations);
      return null;
    });
    client.connection.listen();
    client.initialized = await client.request('initialize', {
      processId: process.pid,
      rootUri: null,
      capabilities,
      ...more,
      // What a run shows comes later than the rest; tests of it ask for it.
      initializationOptions: { verify: 'off', ...more.initializationOptions },
    });
    client.notify('initialized', {});
    return client;
  }

  request(method, params) {
    return this.connection.sendRequest(method, params);
  }

  notify(method, params) {
    return this.connection.sendNotification(method, params);
  }

  open(uri, text, version = 1) {
    this.notify('textDocument/didOpen', { textDocument: { uri, languageId: 'isocnc', version, text } });
  }

  openFile(file) {
    const uri = uriOf(file);
    this.open(uri, readFileSync(file, 'utf8'));
    return uri;
  }

  change(uri, version, ...contentChanges) {
    this.notify('textDocument/didChange', { textDocument: { uri, version }, contentChanges });
  }

  /** The diagnostics published of this version; of any version without one. */
  diagnostics(uri, version) {
    const known = this.#published.get(uri);
    if (known && (version === undefined || known.version === version)) return Promise.resolve(known.diagnostics);
    return new Promise((resolve) => this.#waiting.push({ uri, version, resolve }));
  }

  async stop() {
    await this.connection.sendRequest('shutdown');
    this.notify('exit');
    return this.exit;
  }

  #take(params) {
    this.#published.set(params.uri, params);
    this.#waiting = this.#waiting.filter(({ uri, version, resolve }) => {
      const fits = uri === params.uri && (version === undefined || version === params.version);
      if (fits) resolve(params.diagnostics);
      return !fits;
    });
  }
}

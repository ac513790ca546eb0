// Microsoft's own client of the debug adapter protocol, speaking with isodap.
import { spawn } from 'node:child_process';
import path from 'node:path';
import { after } from 'node:test';
import { fileURLToPath } from 'node:url';
import testsupport from '@vscode/debugadapter-testsupport';

export const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../../..');
export const programs = process.env.ISOCNC_BIN_DIR ?? path.join(root, 'build/release/bin');
const longestMs = 60_000;

export const example = (name) => path.join(root, 'examples', name);

/** Requests that have been made, of all clients. */
export const asked = new Set();

/** What a test that fails leaves behind would keep the run from its end. */
const processes = [];
after(() => processes.forEach((process) => process.kill('SIGKILL')));

/** A DebugClient whose requests and waits fail when the adapter ends, or nothing comes. */
export class Client {
  #events = [];
  #waiting = [];

  static async start({ initialize = {}, ...launch } = {}) {
    const client = new Client();
    client.process = spawn(path.join(programs, 'isodap'), ['--lang', 'en'], { stdio: ['pipe', 'pipe', 'inherit'] });
    processes.push(client.process);
    client.exit = new Promise((resolve) => client.process.on('exit', (code, signal) => resolve(code ?? signal)));
    client.debug = new testsupport.DebugClient('isodap', '', 'isocnc');
    client.debug.connect(client.process.stdout, client.process.stdin);
    const send = client.debug.send.bind(client.debug);
    client.debug.send = (command, ...rest) => {
      asked.add(command);
      return send(command, ...rest);
    };
    for (const name of ['initialized', 'stopped', 'terminated', 'exited', 'output', 'breakpoint', 'invalidated', 'loadedSource', 'progressStart',
      'progressEnd', 'isocnc/position'])
      client.debug.on(name, (event) => client.#take(name, event.body));
    client.capabilities = (await client.request('initializeRequest', {
      adapterID: 'isocnc',
      linesStartAt1: true,
      columnsStartAt1: true,
      pathFormat: 'path',
      ...initialize,
    })).body;
    if (launch.program) {
      client.program = launch.program;
      await client.request('launchRequest', launch);
      await client.event('initialized');
    }
    return client;
  }

  #take(name, body) {
    const index = this.#waiting.findIndex((waiting) => waiting.name === name && waiting.fits(body));
    if (index < 0) this.#events.push({ name, body });
    else this.#waiting.splice(index, 1)[0].resolve(body);
  }

  /** The next event of this name that fits, also one that has come already. */
  event(name, fits = () => true) {
    const index = this.#events.findIndex((event) => event.name === name && fits(event.body));
    if (index >= 0) return Promise.resolve(this.#events.splice(index, 1)[0].body);
    return this.#race(new Promise((resolve) => this.#waiting.push({ name, fits, resolve })), name);
  }

  /** A request by the name of the client's method. */
  request(method, args = {}) {
    return this.#race(this.debug[method](args), method);
  }

  /** A request by its name in the protocol, where the client has no method. */
  custom(command, args = {}) {
    return this.#race(this.debug.customRequest(command, args), command);
  }

  #race(promise, what) {
    let timer;
    const late = new Promise((_, reject) => {
      timer = setTimeout(() => reject(new Error(`${what}: nothing has come`)), longestMs);
    });
    const gone = this.exit.then((status) => Promise.reject(new Error(`${what}: isodap has ended with ${status}`)));
    return Promise.race([promise, late, gone]).finally(() => clearTimeout(timer));
  }

  /** Lets the program go on, and waits until it stops. */
  async run(method, args = {}) {
    await this.request(method, { threadId: 1, ...args });
    return this.event('stopped');
  }

  async setBreakpoints(breakpoints) {
    const answer = await this.request('setBreakpointsRequest', {
      source: { path: this.program },
      lines: breakpoints.map(({ line }) => line),
      breakpoints,
    });
    return answer.body.breakpoints;
  }

  async frames() {
    return (await this.request('stackTraceRequest', { threadId: 1 })).body.stackFrames;
  }

  async line() {
    return (await this.frames())[0].line;
  }

  async evaluate(expression, context = 'watch') {
    return (await this.request('evaluateRequest', { expression, context })).body.result;
  }

  /** The variables of a scope, by name. */
  async variables(scope) {
    const { scopes } = (await this.request('scopesRequest', { frameId: 1 })).body;
    const { variablesReference } = scopes.find(({ name }) => name === scope);
    const { variables } = (await this.request('variablesRequest', { variablesReference })).body;
    return new Map(variables.map((variable) => [variable.name, variable.value]));
  }

  async stop() {
    // The adapter may be gone before the client has read that it may be.
    this.debug.disconnectRequest().catch(() => {});
    return this.exit;
  }
}

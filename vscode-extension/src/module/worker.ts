/** The worker of the WebAssembly module: what web/src/worker.ts takes and sends. */
import * as vscode from 'vscode';
import type { Answer, Changes, Command, Start } from '../../../web/src/worker';

export interface Port {
  postMessage(message: unknown): void;
  terminate(): void;
}

/** Starts a worker that runs a script, as this editor can. */
export type StartWorker = (script: string, onMessage: (message: unknown) => void, onError: (message: string) => void) => Port;

export class Workers {
  private content: Promise<[script: string, wasm: ArrayBuffer]> | null = null;

  constructor(
    private readonly extension: vscode.Uri,
    private readonly start: StartWorker,
  ) {}

  /** A worker that holds a server. */
  async serve(start: Omit<Start, 'wasm'>, onMessage: (message: unknown) => void, onError: (message: string) => void): Promise<Port> {
    const [script, wasm] = await this.load();
    const port = this.start(script, onMessage, onError);
    port.postMessage({ ...start, wasm } satisfies Start);
    return port;
  }

  /** Runs a command in a module of its own. */
  async run(files: Changes['files'], command: Omit<Command, 'run'>): Promise<Answer> {
    let port: Port | null = null;
    try {
      return await new Promise<Answer>((done, failed) => {
        const take = (message: unknown) => (typeof message === 'object' && message !== null && 'run' in message ? done(message as Answer) : undefined);
        this.serve({ server: 'isols' }, take, (message) => failed(new Error(message))).then((started) => {
          port = started;
          port.postMessage({ files } satisfies Changes);
          port.postMessage({ run: 1, ...command } satisfies Command);
        }, failed);
      });
    } finally {
      (port as Port | null)?.terminate();
    }
  }

  private load(): Promise<[string, ArrayBuffer]> {
    this.content ??= Promise.all(['worker.js', 'isocnc.wasm'].map((name) => vscode.workspace.fs.readFile(vscode.Uri.joinPath(this.extension, 'dist/web', name)))).then(
      ([script, wasm]) => [new TextDecoder().decode(script), new Uint8Array(wasm).buffer],
    );
    // It may come the next time, over a network.
    this.content.catch(() => (this.content = null));
    return this.content;
  }
}

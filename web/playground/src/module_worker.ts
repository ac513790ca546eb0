/** The WebAssembly module in a worker, with one of its servers. */
import { XzReadableStream } from 'xz-decompress';
import type { Outcome } from '../../src/streams';
import type { Changes, Command, Start } from '../../src/worker';

/** What module.js leaves on the page: a page from a disk may fetch nothing, but it may have scripts. */
interface Embedded {
  /** playground.wasm, compressed with xz, in base64. */
  wasm: string;
  /** The script of the worker. */
  worker: string;
}

declare global {
  var isocncModule: Embedded | undefined;
}

let unpacked: Promise<ArrayBuffer> | undefined;

async function unpack(base64: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  return new Response(new XzReadableStream(new Blob([bytes]).stream())).arrayBuffer();
}

/** The scripts of the page have run when all of it has been read. */
async function embedded(): Promise<Embedded> {
  if (!globalThis.isocncModule && document.readyState !== 'complete')
    await new Promise((resolve) => window.addEventListener('load', resolve, { once: true }));
  if (!globalThis.isocncModule) throw new Error('module.js');
  return globalThis.isocncModule;
}

export class ModuleWorker {
  /** Gets the server's messages. */
  onMessage: (message: unknown) => void = () => undefined;
  /** The worker cannot go on. */
  onFailure: (message: string) => void = () => undefined;

  private readonly worker: Worker;
  private readonly waiting = new Map<number, (outcome: Outcome) => void>();
  private last = 0;

  static async start(server: Start['server'], language: string): Promise<ModuleWorker> {
    const { wasm, worker } = await embedded();
    unpacked ??= unpack(wasm);
    const url = URL.createObjectURL(new Blob([worker], { type: 'text/javascript' }));
    const made = new ModuleWorker(new Worker(url));
    made.post({ server, wasm: await unpacked, language } satisfies Start);
    return made;
  }

  private constructor(worker: Worker) {
    this.worker = worker;
    worker.onmessage = ({ data }: MessageEvent<unknown>) => {
      if (typeof data === 'object' && data !== null && 'run' in data) this.answer(data as Outcome & { run: number });
      else this.onMessage(data);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      this.onFailure(event.message);
    };
  }

  /** Sends a message to the server. */
  send(message: object): void {
    this.post(message);
  }

  changeFiles(files: Changes['files']): void {
    this.post({ files } satisfies Changes);
  }

  run(program: Command['program'], args: readonly string[]): Promise<Outcome> {
    return new Promise((resolve) => {
      this.waiting.set(++this.last, resolve);
      this.post({ run: this.last, program, args } satisfies Command);
    });
  }

  end(): void {
    this.worker.terminate();
  }

  private answer({ run, ...outcome }: Outcome & { run: number }): void {
    this.waiting.get(run)?.(outcome);
    this.waiting.delete(run);
  }

  private post(message: object): void {
    this.worker.postMessage(message);
  }
}

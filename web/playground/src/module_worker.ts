/** The WebAssembly module in a worker, with one of its servers. */
import type { Outcome } from '../../src/streams';
import type { Changes, Command, Start } from '../../src/worker';
import type {} from './module';

export class ModuleWorker {
  /** Gets the server's messages. */
  onMessage: (message: unknown) => void = () => undefined;
  /** The worker cannot go on. */
  onFailure: (message: string) => void = () => undefined;

  private readonly worker: Worker;
  private readonly waiting = new Map<number, (outcome: Outcome) => void>();
  private last = 0;

  static async start(server: Start['server'], language: string): Promise<ModuleWorker> {
    if (!globalThis.isocncModule) throw new Error('module.js');
    const { compiled, makeWorker } = globalThis.isocncModule;
    const wasm = await compiled;
    const made = new ModuleWorker(makeWorker());
    made.post({ server, wasm, language } satisfies Start);
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

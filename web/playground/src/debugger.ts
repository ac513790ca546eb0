/** isodap in a worker: one run of the program on the simulated machine, forwards and backwards. */
import { ModuleWorker } from './module_worker';
import { readPosition, type MachinePosition } from '../../../toolpath-view/src/machine_position';
import type { Language } from './texts';

const program = '/program/program.iso';

interface Message {
  type: 'request' | 'response' | 'event';
  request_seq?: number;
  command?: string;
  event?: string;
  success?: boolean;
  message?: string;
  body?: Record<string, unknown> & { error?: { format: string } };
}

/** Where the machine stands, and what is in force. */
export interface Standing extends MachinePosition {
  /** In the frame in force, as programmed; mm and degrees. */
  programmed: Record<'x' | 'y' | 'z' | 'b' | 'c', number>;
  /** mm/min, as programmed. */
  feed: string;
  spindle: { function: number; speed: number };
  tool: { name: string } | null;
}

export interface Stop {
  standing: Standing;
  /** What the control says, where it has stopped the program. */
  error: string | null;
}

export type Step = 'next' | 'stepBack' | 'continue';

export class Debugger {
  /** The machine has come to a stand. */
  onStop: (stop: Stop) => void = () => undefined;
  /** The run is over; the last place where the machine was. */
  onEnd: (last: Standing | null) => void = () => undefined;

  private readonly waiting = new Map<number, { resolve: (body: Message['body']) => void; reject: (error: Error) => void }>();
  private initialized: () => void = () => undefined;
  private last = 0;
  private place: Standing | null = null;
  private isOver = false;

  private constructor(private readonly worker: ModuleWorker) {
    worker.onMessage = (message) => this.receive(message as Message);
    worker.onFailure = () => this.end();
  }

  /** Starts a run, which stops before the first block. Throws what the adapter complains of. */
  static async start(text: string, language: Language, breakpoints: readonly number[], prepare: (made: Debugger) => void): Promise<void> {
    const made = new Debugger(await ModuleWorker.start('isodap', language));
    prepare(made);
    made.worker.changeFiles({ [program]: text });
    try {
      await made.request('initialize', { adapterID: 'isocnc', linesStartAt1: true, columnsStartAt1: true, pathFormat: 'path', locale: language });
      const isReady = new Promise<void>((resolve) => (made.initialized = resolve));
      await made.request('launch', { program, stopOnEntry: true });
      await isReady;
      await made.setBreakpoints(breakpoints);
      await made.request('configurationDone', {});
    } catch (error) {
      made.stop();
      throw error;
    }
  }

  async go(step: Step): Promise<void> {
    await this.request(step, { threadId: 1 });
  }

  /** Lines count from 1. */
  async setBreakpoints(lines: readonly number[]): Promise<void> {
    await this.request('setBreakpoints', { source: { path: program }, breakpoints: lines.map((line) => ({ line })) });
  }

  /** Ends the run, without a word to anybody. */
  stop(): void {
    this.isOver = true;
    this.worker.end();
  }

  private end(): void {
    if (this.isOver) return;
    this.stop();
    this.onEnd(this.place);
  }

  private request(command: string, body: object): Promise<Message['body']> {
    const seq = ++this.last;
    return new Promise((resolve, reject) => {
      this.waiting.set(seq, { resolve, reject });
      this.worker.send({ seq, type: 'request', command, arguments: body });
    });
  }

  private receive(message: Message): void {
    if (this.isOver) return;
    if (message.type === 'response') {
      const request = this.waiting.get(message.request_seq!);
      this.waiting.delete(message.request_seq!);
      if (message.success) request?.resolve(message.body);
      else request?.reject(new Error(message.body?.error?.format ?? message.message ?? message.command));
      return;
    }
    if (message.event === 'initialized') this.initialized();
    if (message.event === 'isocnc/position') this.take(message.body);
    if (message.event === 'stopped') void this.report(message.body);
    if (message.event === 'terminated') this.end();
  }

  private take(body: Message['body']): void {
    const position = readPosition(body);
    if (!position) return;
    const { programmed, spindle, tool } = body as unknown as Standing;
    this.place = { ...position, programmed, feed: this.place?.feed ?? '', spindle, tool };
  }

  private async report(body: Message['body']): Promise<void> {
    const { reason, description, text } = body as { reason: string; description?: string; text?: string };
    const answer = (await this.request('evaluate', { expression: 'F', context: 'watch' })) as { result: string };
    if (this.place) this.place.feed = answer.result;
    const error = reason === 'exception' ? [text, description].filter(Boolean).join(' ') : null;
    if (this.place) this.onStop({ standing: this.place, error });
  }
}

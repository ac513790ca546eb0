/** A conversation with one of the two servers in the module: JSON messages in, JSON messages out. */
import { withTexts, type Module, type Server } from './module';

/** How long a server may work before the events of the page have their turn; milliseconds. */
const turn = 20;

export class Conversation {
  private readonly number: number;
  private timer: ReturnType<typeof setTimeout> | null = null;
  private isOver = false;

  /**
   * `onMessage` gets the bodies of the server's messages, `onEnd` is called after the last one. `language` is en, it,
   * or empty for what the client asks for.
   */
  constructor(
    private readonly module: Module,
    server: Server,
    language: string,
    onMessage: (body: string) => void,
    private readonly onEnd: (exitStatus: number) => void = () => undefined,
  ) {
    this.number = withTexts(module, [server, language], (name, code) => module._isocnc_begin(name, code));
    const others = module.onmessage;
    module.onmessage = (conversation, body) => (conversation === this.number ? onMessage(body) : others?.(conversation, body));
  }

  send(body: string): void {
    if (this.isOver) return;
    withTexts(this.module, [body], (text) => this.module._isocnc_receive(this.number, text));
    this.workIn(0);
  }

  private workIn(milliseconds: number): void {
    if (this.timer !== null) clearTimeout(this.timer);
    this.timer = setTimeout(() => this.work(), milliseconds);
  }

  private work(): void {
    this.timer = null;
    const next = this.module._isocnc_work(this.number, turn);
    if (next >= 0) return this.workIn(next);
    if (next === -1) return;
    this.isOver = true;
    this.onEnd(this.module._isocnc_end(this.number));
  }
}

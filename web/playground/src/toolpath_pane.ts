/** The toolpath beside the program: asked for after each edit, shown by the view that isorun's page has, too. */
import { byId, element } from '../../../toolpath-view/src/elements';
import { Panel } from '../../../toolpath-view/src/panel';
import { Toolpath, type Recording } from '../../../toolpath-view/src/toolpath';
import { applied, received, type SentToolpath } from '../../../toolpath-view/src/streams';
import type { MachinePosition } from '../../../toolpath-view/src/machine_position';
import { RequestError, textDocument, type LanguageServer } from './language_server';
import type { Theme } from './preferences';
import { filled, texts, type Language } from './texts';

/** How long to wait for another edit; milliseconds. */
const delay = 120;

const bytesOf = (base64: string) => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));

export class ToolpathPane {
  /** A move of this line has been chosen in the picture; lines count from 0. */
  onPick: (line: number) => void = () => undefined;
  /** The tool passes this line while the time runs. */
  onPass: (line: number) => void = () => undefined;

  private server: LanguageServer | null = null;
  private panel: Panel | null = null;
  private recording: Recording | null = null;
  private resultId: string | undefined;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private asking: AbortController | null = null;
  private isOther = true;
  private lines = { first: 0, last: 0 };
  private problem = '';
  private isSeen = false;

  constructor(
    private language: Language,
    private theme: Theme,
  ) {
    // Behind a tab there is no size to which a path could be fitted.
    new ResizeObserver(() => {
      const isSeen = byId('stage').clientWidth > 0;
      if (isSeen && !this.isSeen) this.panel?.view?.look('iso');
      this.isSeen = isSeen;
    }).observe(byId('stage'));
  }

  connect(server: LanguageServer): void {
    this.server = server;
    void this.ask();
  }

  /** The program has been edited, or with `isOther` it is another one, which is looked at anew. */
  change(isOther: boolean): void {
    this.isOther ||= isOther;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.ask(), delay);
  }

  /** Lights up what these lines do. */
  choose(first: number, last: number): void {
    this.lines = { first, last };
    if (this.panel && !this.panel.player.isPlaying) this.panel.choose(first, last);
  }

  pose(position: MachinePosition): void {
    this.panel?.pose(position);
  }

  /** Where the tool is drawn, in the frame of the machine. */
  get tip(): number[] {
    return this.panel ? this.panel.shownPath.at(this.panel.player.time).tip : [];
  }

  /** Where a place of the machine is in the picture, in pixels. */
  project(tip: [number, number, number]): { x: number; y: number } | null {
    return this.panel?.view?.project(tip) ?? null;
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.panel?.setTheme(theme);
  }

  setLanguage(language: Language): void {
    this.language = language;
    this.panel?.setLanguage(language);
    this.showProblem();
  }

  private async ask(): Promise<void> {
    if (!this.server) return;
    this.asking?.abort();
    const asking = (this.asking = new AbortController());
    try {
      const params = { textDocument, previousResultId: this.resultId };
      const sent = await this.server.request<SentToolpath>('isocnc/toolpath', params, asking.signal);
      if (!asking.signal.aborted) this.take(sent);
    } catch (error) {
      if (asking.signal.aborted) return;
      if (error instanceof RequestError && error.isOutdated) { this.change(false); return; }
      this.problem = (error as Error).message;
      this.showProblem();
    }
  }

  private take(sent: SentToolpath): void {
    this.recording = applied(this.recording, sent.facts, received(sent, bytesOf));
    this.resultId = sent.resultId;
    const path = new Toolpath(this.recording);
    if (this.panel) this.panel.take(path);
    else this.panel = this.makePanel(path);
    if (this.isOther) {
      this.panel.player.seek(0);
      this.panel.view?.look('iso');
    }
    this.isOther = false;
    this.problem = '';
    this.panel.setLanguage(this.language);
    this.choose(this.lines.first, this.lines.last);
    byId('view').dataset.result = sent.resultId;
  }

  private makePanel(path: Toolpath): Panel {
    byId('stage').replaceChildren();
    byId('toolpath').classList.remove('empty');
    const panel = new Panel(path, this.language, this.theme, ['head', 'stock'], byId('toolpath'));
    panel.onPick = (line) => this.onPick(line);
    panel.onLine = (line) => {
      if (panel.player.isPlaying) this.onPass(line);
    };
    return panel;
  }

  private showProblem(): void {
    if (!this.problem) return;
    const text = filled(texts[this.language].noToolpath, this.problem);
    if (this.panel) byId('outcome').textContent = text;
    else byId('stage').replaceChildren(element('p', { className: 'problem' }, text));
  }
}

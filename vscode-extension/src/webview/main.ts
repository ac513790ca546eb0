/** The page in the toolpath's panel. It has the view of isorun's page; program and cursor are the editor's. */
import { Comparison } from '../../../toolpath-view/src/comparison';
import { byId, element } from '../../../toolpath-view/src/elements';
import { Panel } from '../../../toolpath-view/src/panel';
import { Toolpath, type Recording, type Vector } from '../../../toolpath-view/src/toolpath';
import type { ToPage, ToPanel } from '../toolpath/messages';
import { applied } from '../../../toolpath-view/src/streams';
import { backgroundOf, themeOf } from './theme';

declare function acquireVsCodeApi(): { postMessage(message: ToPanel): void };

class Page {
  private readonly editor = acquireVsCodeApi();
  private recording: Recording | null = null;
  private resultId: string | null = null;
  private program: string | null = null;
  private path: Toolpath | null = null;
  private panel: Panel | null = null;
  private stock: Vector | null = null;
  private comparison: Comparison | null = null;

  constructor() {
    window.addEventListener('message', ({ data }: MessageEvent<ToPage>) => this.receive(data));
    new MutationObserver(() => this.panel?.setTheme(themeOf(document.body), backgroundOf(document.body))).observe(document.body, {
      attributes: true,
      attributeFilter: ['class'],
    });
    this.editor.postMessage({ type: 'ready' });
  }

  private receive(message: ToPage): void {
    switch (message.type) {
      case 'path':
        return this.take(message);
      case 'comparison':
        return this.compare(message);
      case 'problem':
        return this.showProblem(message.message);
      case 'lines':
        if (!this.panel?.player.isPlaying) this.panel?.choose(message.first, message.last);
        return;
      case 'hide':
        return this.panel?.hideLines(message.lines);
      case 'pose':
        return this.panel?.pose(message);
      case 'stock':
        this.stock = message.size;
        return this.placeStock();
    }
  }

  /** A comparison that an edit has overtaken is followed by another one. */
  private compare({ resultId, overlay }: Extract<ToPage, { type: 'comparison' }>): void {
    if (!this.panel || !this.path || resultId !== this.resultId) return;
    this.comparison = overlay && new Comparison({ old: new Toolpath(overlay.old), new: this.path }, overlay);
    this.panel.compare(this.comparison);
    this.publish(this.panel);
  }

  /** For tests, which look from outside. */
  private publish({ view, player }: Panel): void {
    Object.assign(window, { isocnc: { path: this.path, view, player, comparison: this.comparison } });
  }

  private take(message: Extract<ToPage, { type: 'path' }>): void {
    if (message.previousResultId !== null && message.previousResultId !== this.resultId) {
      this.editor.postMessage({ type: 'resend' });
      return;
    }
    this.recording = applied(this.recording, message.facts, message.patches);
    this.resultId = message.resultId;
    this.path = new Toolpath(this.recording);
    // Another path is compared anew.
    if (this.comparison) this.panel?.compare(null);
    this.comparison = null;
    if (this.panel) this.panel.take(this.path);
    else this.panel = this.makePanel(this.path, message.language);
    this.panel.setLanguage(message.language);
    this.placeStock();
    if (message.program !== this.program) this.panel.view?.fit();
    this.program = message.program;
    this.showProblem('');
    this.publish(this.panel);
    document.documentElement.dataset.ready = String(Number(document.documentElement.dataset.ready ?? 0) + 1);
  }

  private makePanel(path: Toolpath, language: 'en' | 'it'): Panel {
    byId('stage').replaceChildren();
    const panel = new Panel(path, language, themeOf(document.body));
    panel.setTheme(themeOf(document.body), backgroundOf(document.body));
    panel.onPick = (line) => this.editor.postMessage({ type: 'picked', line });
    // A page in an editor cannot download.
    panel.onSave = (name, content) => {
      void content.arrayBuffer().then((bytes) => this.editor.postMessage({ type: 'save', name, content: new Uint8Array(bytes) }));
    };
    panel.compared.onChange = (change) => {
      const lines = this.comparison?.changes[change]?.new;
      if (lines) this.editor.postMessage({ type: 'picked', line: lines[0] - 1 });
    };
    panel.onLine = (line) => {
      if (panel.player.isPlaying) this.editor.postMessage({ type: 'passing', line });
    };
    return panel;
  }

  /** From the first workpiece zero, whose axes are the machine's. */
  private placeStock(): void {
    const zero = this.path?.facts.frames.find(({ i, j, k }) => i[0] === 1 && j[1] === 1 && k[2] === 1)?.origin ?? [0, 0, 0];
    const size = this.stock;
    this.panel?.view?.setStock(
      size && { min: [zero[0], zero[1], zero[2] - size[2]], max: [zero[0] + size[0], zero[1] + size[1], zero[2]] },
    );
  }

  private showProblem(problem: string): void {
    if (problem && !this.panel) byId('stage').replaceChildren(element('p', { className: 'problem' }, problem));
    else if (problem) byId('outcome').textContent = problem;
  }
}

new Page();

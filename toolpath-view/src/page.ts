/** The page of isorun --plot FILE.html: a run's path, program and time side by side. */
import type { Theme } from './colors';
import { byId, element } from './elements';
import { icon } from './icons';
import { Panel } from './panel';
import { ProgramList } from './program_list';
import { ProgramText } from './program_text';
import { texts, type Language } from './texts';
import { Toolpath, type Facts } from './toolpath';

/** Takes a block of data out of the page, so that its text need not stay in memory; empty where there is none. */
function takeBytes(id: string): Uint8Array {
  const block = document.getElementById(`data-${id}`);
  if (!block) return new Uint8Array();
  const text = atob(block.textContent ?? '');
  block.remove();
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

class Page {
  private readonly facts = JSON.parse(byId('data-facts').textContent ?? '') as Facts;
  private readonly path = new Toolpath({
    facts: this.facts,
    steps: takeBytes('steps'),
    points: takeBytes('points'),
    turns: takeBytes('turns'),
    cuts: takeBytes('cuts'),
  });
  private readonly program = new ProgramText(takeBytes('program'));
  private readonly list = new ProgramList(byId('program'), this.program, (line) => {
    const { start, end } = this.path.stepsOf(line);
    return end > start;
  });
  private readonly panel: Panel;
  private language: Language = this.facts.language;
  private theme: Theme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';

  constructor() {
    document.documentElement.dataset.theme = this.theme;
    this.panel = new Panel(this.path, this.language, this.theme, ['head', 'stock']);
    this.panel.onLine = (line) => this.list.show(line);
    this.panel.onPick = (line) => this.list.show(line);
    if (this.path.stepCount > 0) this.list.show(this.path.stepLine[this.panel.player.step]);
    this.setUp();
    this.write();
    // For who looks at the page from outside: tests, and a curious reader's console.
    Object.assign(window, { isocnc: { path: this.path, view: this.panel.view, player: this.panel.player } });
    document.documentElement.dataset.ready = 'true';
  }

  private setUp(): void {
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', (dark) => this.setTheme(dark.matches ? 'dark' : 'light'));
    byId('theme').append(icon('theme'));
    byId('theme').addEventListener('click', () => this.setTheme(this.theme === 'dark' ? 'light' : 'dark'));
    byId('language').addEventListener('click', () => {
      this.language = this.language === 'en' ? 'it' : 'en';
      this.panel.setLanguage(this.language);
      this.write();
    });
    this.list.onChoose = (line) => this.panel.choose(line);
    byId('program').addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey || !['ArrowUp', 'ArrowDown'].includes(event.key)) return;
      event.preventDefault();
      this.panel.walk(event.key === 'ArrowUp' ? -1 : 1);
    });
    document.title = this.facts.name;
    byId('name').textContent = this.facts.name;
  }

  private setTheme(theme: Theme): void {
    this.theme = theme;
    document.documentElement.dataset.theme = theme;
    this.panel.setTheme(theme);
  }

  private write(): void {
    const { otherLanguage, theme } = texts[this.language];
    byId('language').textContent = otherLanguage;
    byId('language').lang = this.language === 'en' ? 'it' : 'en';
    byId('theme').title = theme;
    byId('theme').setAttribute('aria-label', theme);
  }
}

try {
  new Page();
} catch (problem) {
  const language = document.documentElement.lang === 'it' ? 'it' : 'en';
  document.body.replaceChildren(element('p', { className: 'problem' }, `${texts[language].unreadable} ${String(problem)}`));
  throw problem;
}

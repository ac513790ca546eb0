/** The page of isorun --plot FILE.html and of isodiff --format html: paths, programs and time side by side. */
import type { Theme } from './colors';
import { Comparison, type ComparisonFacts } from './comparison';
import { byId, element } from './elements';
import { icon } from './icons';
import { OneProgram, TwoPrograms, type PagePrograms } from './page_programs';
import { Panel } from './panel';
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

function takePath(prefix: '' | 'old-'): Toolpath {
  return new Toolpath({
    facts: JSON.parse(byId(`data-${prefix}facts`).textContent ?? '') as Facts,
    steps: takeBytes(`${prefix}steps`),
    points: takeBytes(`${prefix}points`),
    turns: takeBytes(`${prefix}turns`),
    cuts: takeBytes(`${prefix}cuts`),
  });
}

/** None in the page of one program. */
function takeComparison(path: Toolpath): Comparison | null {
  const facts = document.getElementById('data-comparison');
  if (!facts) return null;
  const recording = { facts: JSON.parse(facts.textContent ?? '') as ComparisonFacts, alignment: takeBytes('alignment') };
  return new Comparison({ old: takePath('old-'), new: path }, recording);
}

class Page {
  private readonly path = takePath('');
  private readonly comparison = takeComparison(this.path);
  private readonly panel: Panel;
  private readonly programs: PagePrograms;
  private language: Language = this.path.facts.language;
  private theme: Theme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';

  constructor() {
    document.documentElement.dataset.theme = this.theme;
    const { comparison } = this;
    this.panel = new Panel(this.path, this.language, this.theme, ['head', 'stock']);
    const program = new ProgramText(takeBytes('program'));
    this.programs = comparison
      ? new TwoPrograms(this.panel, comparison, { old: new ProgramText(takeBytes('old-program')), new: program })
      : new OneProgram(this.panel, program);
    this.setUp();
    this.write();
    // For who looks at the page from outside: tests, and a curious reader's console.
    Object.assign(window, { isocnc: { path: this.path, comparison, view: this.panel.view, player: this.panel.player } });
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
    byId('program').addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey || !['ArrowUp', 'ArrowDown'].includes(event.key)) return;
      event.preventDefault();
      this.programs.walk(event.key === 'ArrowUp' ? -1 : 1);
    });
    const { name } = this.path.facts;
    const old = this.comparison?.paths.old.facts.name;
    byId('name').textContent = document.title = old === undefined || old === name ? name : `${old} → ${name}`;
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
    this.programs.write(this.language);
  }
}

try {
  new Page();
} catch (problem) {
  const language = document.documentElement.lang === 'it' ? 'it' : 'en';
  document.body.replaceChildren(element('p', { className: 'problem' }, `${texts[language].unreadable} ${String(problem)}`));
  throw problem;
}

/** The findings below the program: each leads to its line, has its fix and its explanation. */
import { byId, element } from '../../../toolpath-view/src/elements';
import { explanationParts } from './explanation';
import type { CodeAction, Diagnostic } from './protocol';
import { editsOf } from './language_server';
import { filled, texts, type Language } from './texts';

const [errorSeverity, warningSeverity, hintSeverity] = [1, 2, 4];
/** More are in the editor. */
const longestList = 200;

const isSame = (one: Diagnostic, other: Diagnostic) =>
  one.code === other.code &&
  one.message === other.message &&
  one.range.start.line === other.range.start.line &&
  one.range.start.character === other.range.start.character;

/** Whether it makes isolint say nothing, instead of mending the program. */
const silences = ({ edit }: CodeAction) => editsOf(edit).some(({ newText }) => newText.includes('isolint: ignore'));

export class FindingsPane {
  onChoose: (finding: Diagnostic) => void = () => undefined;
  onFix: (fix: CodeAction) => void = () => undefined;
  onExplain: (code: string) => void = () => undefined;

  private findings: Diagnostic[] = [];
  private fixes: CodeAction[] = [];
  private state: 'loading' | 'ready' | { failure: string } = 'loading';
  private explained: { code: string; text: string } | null = null;

  constructor(private language: Language) {
    this.write();
  }

  /** `fixes` are those that the server offers for them. */
  show(findings: Diagnostic[], fixes: CodeAction[]): void {
    this.state = 'ready';
    this.findings = findings.filter(({ severity }) => severity !== hintSeverity);
    this.fixes = fixes.filter((fix) => fix.kind === 'quickfix' && !silences(fix));
    this.write();
  }

  fail(failure: string): void {
    this.state = { failure };
    this.write();
  }

  setLanguage(language: Language): void {
    this.language = language;
    if (this.explained) this.onExplain(this.explained.code);
    this.write();
  }

  explain(code: string, text: string): void {
    this.explained = { code, text };
    this.writeExplanation();
  }

  closeExplanation(): void {
    this.explained = null;
    this.writeExplanation();
  }

  private write(): void {
    const said = texts[this.language];
    byId('findings-list').replaceChildren(...this.rows());
    const count = (severity: number) => this.findings.filter((each) => each.severity === severity).length;
    byId('counts').textContent =
      this.state === 'ready' ? filled(said.counts, count(errorSeverity), count(warningSeverity)) : '';
    byId('findings').dataset.state = typeof this.state === 'string' ? this.state : 'failed';
    const tab = byId('tab-findings');
    tab.textContent = this.findings.length > 0 ? `${said.tabFindings} (${this.findings.length})` : said.tabFindings;
    this.writeExplanation();
  }

  private rows(): HTMLElement[] {
    const said = texts[this.language];
    const message = (text: string) => [element('li', { className: 'message' }, text)];
    if (this.state === 'loading') return message(said.loading);
    if (this.state !== 'ready') return message(filled(said.loadingFailed, this.state.failure));
    if (this.findings.length === 0) return message(said.noFindings);
    return this.findings.slice(0, longestList).map((finding) => this.row(finding));
  }

  private row(finding: Diagnostic): HTMLElement {
    const said = texts[this.language];
    const kind = ({ [errorSeverity]: 'error', [warningSeverity]: 'warning' } as const)[finding.severity] ?? 'hint';
    const go = element(
      'button',
      { type: 'button', className: 'go' },
      element('span', { className: `kind ${kind}` }, said[kind]),
      element('span', { className: 'line' }, filled(said.line, finding.range.start.line + 1)),
      element('span', { className: 'text' }, finding.message),
    );
    go.addEventListener('click', () => this.onChoose(finding));
    const row = element('li', { className: 'finding' }, go);
    const { code } = finding;
    if (code) {
      const explain = element('button', { type: 'button', className: 'code', title: filled(said.explain, code) }, code);
      explain.addEventListener('click', () => this.onExplain(code));
      row.append(explain);
    }
    const fix = this.fixOf(finding);
    if (fix) {
      const button = element('button', { type: 'button', className: 'fix' }, filled(fix.isPreferred ? said.fix : said.unsafeFix, fix.title));
      button.addEventListener('click', () => this.onFix(fix));
      row.append(button);
    }
    return row;
  }

  /** The preferred one, or the first. */
  private fixOf(finding: Diagnostic): CodeAction | undefined {
    const fixes = this.fixes.filter(({ diagnostics }) => diagnostics?.some((each) => isSame(each, finding)));
    return fixes.find(({ isPreferred }) => isPreferred) ?? fixes[0];
  }

  private writeExplanation(): void {
    const said = texts[this.language];
    const place = byId('explanation');
    place.hidden = this.explained === null;
    if (!this.explained) return;
    const { code, text } = this.explained;
    const [title, ...rest] = text.split('\n');
    const close = element('button', { type: 'button', className: 'close' }, said.close);
    close.addEventListener('click', () => {
      this.closeExplanation();
      byId('findings-list').focus();
    });
    const parts: HTMLElement[] = [
      element('div', { className: 'head' }, element('strong', {}, title), close),
      ...explanationParts(rest),
    ];
    // Within the site of the documentation, which marks its copy of the page.
    const anchor = title.split(' ', 2).join('-').toLowerCase();
    const { site } = document.documentElement.dataset;
    if (site)
      parts.push(element('p', {}, element('a', { href: `${site}/docs/${pages[this.language]}#${anchor}` }, filled(said.documentationOf, code))));
    place.replaceChildren(...parts);
    place.scrollTop = 0;
  }
}

/** The pages of the codes. */
const pages: Record<Language, string> = { en: 'rules.html', it: 'it/codici.html' };

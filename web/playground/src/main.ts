/** The page: an editor, its findings and its toolpath, with both servers in the browser. */
import { byId, element } from '../../../toolpath-view/src/elements';
import { icon } from '../../../toolpath-view/src/icons';
import { ProgramEditor } from './editor';
import { broken, right, type Example } from './examples';
import { acceptDrops, FileFailure, largestFile, save, textOf } from './files';
import { FindingsPane } from './findings_pane';
import { keepProgram, keptProgram } from './kept_program';
import { LanguageServer, RequestError, textDocument } from './language_server';
import { fragmentOf, LinkError, longestLink, programOf } from './link';
import { chosenLanguage, chosenTheme, keepLanguage, keepTheme, onSystemTheme, type Theme } from './preferences';
import type { CodeAction, Diagnostic, TextEdit } from './protocol';
import { rangeOf, registerProviders } from './providers';
import { RunPane } from './run_pane';
import { Tabs } from './tabs';
import { filled, texts, type Language, type Texts } from './texts';
import { ToolpathPane } from './toolpath_pane';

class Page {
  private language: Language = chosenLanguage();
  private theme: Theme = chosenTheme();
  private fileName: string;
  private server: LanguageServer | null = null;
  private findings: Diagnostic[] = [];
  private readonly tabs = new Tabs();
  private readonly editor: ProgramEditor;
  private readonly findingsPane: FindingsPane;
  private readonly toolpath: ToolpathPane;
  private readonly run: RunPane;

  constructor() {
    this.applyTheme();
    const kept = keptProgram();
    const program = kept ?? { name: broken[0].file, text: broken[0].text };
    this.fileName = program.name;
    this.editor = new ProgramEditor(byId('editor'), program.text, this.theme, this.said.editor);
    this.findingsPane = new FindingsPane(this.language);
    this.toolpath = new ToolpathPane(this.language, this.theme);
    this.run = new RunPane(this.language, this.editor);
    this.joinPanes();
    this.setUpButtons();
    this.setUpDialog();
    this.write();
    void this.startServer();
    if (!kept) void this.readLink();
    window.addEventListener('pagehide', () => keepProgram({ name: this.fileName, text: this.editor.text }));
    // For tests, which look from outside.
    Object.assign(window, { playground: { editor: this.editor, toolpath: this.toolpath } });
  }

  private get said(): Texts {
    return texts[this.language];
  }

  // --- The server

  private async startServer(): Promise<void> {
    try {
      const fail = (message: string) => this.findingsPane.fail(message);
      // What is typed while the module is loaded belongs to the program that it gets.
      const text = this.editor.text;
      const [server, capabilities] = await LanguageServer.start(text, this.language, fail);
      server.onFindings = (findings) => void this.take(findings);
      this.server = server;
      server.setLanguage(this.language);
      const now = this.editor.text;
      if (now !== text) server.change([{ text: now }]);
      registerProviders(server, capabilities, () => this.findings);
      this.toolpath.connect(server);
    } catch (failure) {
      this.findingsPane.fail((failure as Error).message);
    }
  }

  private async take(findings: Diagnostic[]): Promise<void> {
    this.findings = findings;
    this.editor.show(findings);
    this.findingsPane.show(findings, []);
    if (findings.length === 0) return;
    const last = Math.max(...findings.map(({ range }) => range.end.line)) + 1;
    const range = { start: { line: 0, character: 0 }, end: { line: last, character: 0 } };
    try {
      const context = { diagnostics: findings, only: ['quickfix'] };
      const fixes = await this.server!.request<CodeAction[] | null>('textDocument/codeAction', { textDocument, range, context });
      if (findings === this.findings) this.findingsPane.show(findings, fixes ?? []);
    } catch (error) {
      if (!(error instanceof RequestError)) throw error;
    }
  }

  // --- The parts of the page and each other

  private joinPanes(): void {
    const { editor, findingsPane, toolpath, run } = this;
    editor.onEdit = ({ changes }) => {
      this.server?.change(changes);
      toolpath.change(false);
      run.leave(false);
    };
    editor.onSelect = (first, last) => {
      if (!run.isRunning) toolpath.choose(first, last);
    };
    editor.onBreakpoints = () => run.updateBreakpoints();
    findingsPane.onChoose = ({ range }) => {
      this.tabs.show('source');
      editor.go(range.start.line, range.start.character);
      editor.focus();
    };
    findingsPane.onFix = (fix) => void this.fix(fix);
    findingsPane.onExplain = (code) => void this.explain(code);
    toolpath.onPick = (line) => editor.follow(line);
    toolpath.onPass = (line) => editor.pass(line);
    run.onStand = (standing) => {
      editor.stand(standing?.line ?? null);
      if (standing) toolpath.pose(standing);
    };
  }

  private async fix(fix: CodeAction): Promise<void> {
    const whole = fix.edit ? fix : await this.ask<CodeAction>('codeAction/resolve', fix);
    if (whole) this.editor.applyFix(whole);
  }

  private async explain(code: string): Promise<void> {
    if (this.server) this.findingsPane.explain(code, await this.server.explanationOf(code, this.language));
  }

  /** The server's answer; null where it has none, or the program has been edited meanwhile. */
  private async ask<Result>(method: string, params: object): Promise<Result | null> {
    try {
      return (await this.server?.request<Result>(method, params)) ?? null;
    } catch (error) {
      if (error instanceof RequestError) return null;
      throw error;
    }
  }

  private async format(): Promise<void> {
    const options = { tabSize: 4, insertSpaces: true };
    const edits = await this.ask<TextEdit[]>('textDocument/formatting', { textDocument, options });
    this.editor.apply((edits ?? []).map(({ range, newText }) => ({ range: rangeOf(range), text: newText })));
    this.editor.focus();
  }

  private async fixAll(): Promise<void> {
    const end = { line: this.editor.text.split('\n').length, character: 0 };
    const params = {
      textDocument,
      range: { start: { line: 0, character: 0 }, end },
      context: { diagnostics: [], only: ['source.fixAll'] },
    };
    const [action] = (await this.ask<CodeAction[]>('textDocument/codeAction', params)) ?? [];
    const whole = action && (await this.ask<CodeAction>('codeAction/resolve', action));
    this.say(whole ? '' : this.said.nothingToFix);
    if (whole) this.editor.applyFix(whole);
    this.editor.focus();
  }

  // --- Programs from elsewhere

  private show(name: string, text: string): void {
    this.fileName = name;
    this.run.leave(true);
    this.toolpath.change(true);
    this.findingsPane.closeExplanation();
    this.editor.replace(text);
    byId('name').textContent = name;
  }

  private async open(file: File): Promise<void> {
    try {
      this.show(file.name, await textOf(file));
      this.forgetLink();
      this.say('');
    } catch (failure) {
      if (!(failure instanceof FileFailure)) throw failure;
      this.say(filled(this.said[failure.failure], failure.file, largestFile));
    }
  }

  /** Else a link's program would come back with the next load of the page. */
  private forgetLink(): void {
    if (location.hash) history.replaceState(null, '', location.pathname + location.search);
  }

  private async readLink(): Promise<void> {
    try {
      const program = await programOf(location.hash);
      if (program === null) return;
      this.show('program.iso', program);
      this.say('');
    } catch (failure) {
      if (!(failure instanceof LinkError)) throw failure;
      this.say(filled(this.said.brokenLink, this.said[failure.failure]));
    }
  }

  private async share(): Promise<void> {
    const text = this.editor.text;
    const fragment = await fragmentOf(text).catch((failure: unknown) => {
      if (!(failure instanceof LinkError)) throw failure;
      return null;
    });
    if (fragment === null) { this.say(this.said.tooLargeToShare); return; }
    const link = location.href.replace(/#.*$/s, '') + fragment;
    if (link.length > longestLink) { this.say(filled(this.said.tooLong, link.length, longestLink)); return; }
    this.say('');
    history.replaceState(null, '', fragment);
    byId<HTMLInputElement>('link').value = link;
    byId('copy-result').textContent = '';
    byId<HTMLDialogElement>('share-dialog').showModal();
    byId<HTMLInputElement>('link').select();
  }

  // --- Buttons

  private setUpButtons(): void {
    const on = (id: string, act: () => void) => byId(id).addEventListener('click', act);
    const picker = byId<HTMLInputElement>('picker');
    on('open', () => picker.click());
    picker.addEventListener('change', () => {
      const file = picker.files?.[0];
      picker.value = '';
      if (file) void this.open(file);
    });
    on('save', () => save(this.fileName, this.editor.text));
    on('format', () => void this.format());
    on('fix-all', () => void this.fixAll());
    on('share', () => void this.share());
    on('language', () => this.setLanguage(this.language === 'en' ? 'it' : 'en'));
    byId('theme').append(icon('theme'));
    on('theme', () => {
      this.theme = this.theme === 'dark' ? 'light' : 'dark';
      keepTheme(this.theme);
      this.applyTheme();
    });
    onSystemTheme((theme) => {
      this.theme = theme;
      this.applyTheme();
    });
    const examples = byId<HTMLSelectElement>('examples');
    examples.addEventListener('change', () => {
      const example = [...right, ...broken][Number(examples.value)];
      examples.value = '';
      this.show(example.file, example.text);
      this.forgetLink();
      this.say('');
    });
    acceptDrops((file) => void this.open(file), (is) => (byId('drop').hidden = !is));
    window.addEventListener('hashchange', () => void this.readLink());
    on('dismiss', () => this.say(''));
  }

  private setUpDialog(): void {
    byId('close-share').addEventListener('click', () => byId<HTMLDialogElement>('share-dialog').close());
    byId('copy').addEventListener('click', () => void this.copy());
  }

  private async copy(): Promise<void> {
    const link = byId<HTMLInputElement>('link');
    try {
      await navigator.clipboard.writeText(link.value);
      byId('copy-result').textContent = this.said.copied;
    } catch {
      link.select();
      byId('copy-result').textContent = this.said.notCopied;
    }
  }

  private setLanguage(language: Language): void {
    this.language = language;
    keepLanguage(language);
    this.server?.setLanguage(language);
    this.findingsPane.setLanguage(language);
    this.toolpath.setLanguage(language);
    this.run.setLanguage(language);
    this.write();
  }

  private applyTheme(): void {
    document.documentElement.dataset.theme = this.theme;
    // While the page is made, there is none yet.
    (this.editor as ProgramEditor | undefined)?.setTheme(this.theme);
    (this.toolpath as ToolpathPane | undefined)?.setTheme(this.theme);
  }

  /** A message to the reader; an empty one takes it away. */
  private say(text: string): void {
    byId('notice').hidden = text === '';
    byId('notice-text').textContent = text;
  }

  /** What the page says, in the language chosen. */
  private write(): void {
    const { said } = this;
    document.documentElement.lang = this.language;
    document.title = said.title;
    const textOfKey = (key: string | undefined) => said[key as keyof Texts];
    for (const each of document.querySelectorAll<HTMLElement>('[data-say]')) each.textContent = textOfKey(each.dataset.say);
    for (const each of document.querySelectorAll<HTMLElement>('[data-title]')) each.title = textOfKey(each.dataset.title);
    for (const each of document.querySelectorAll<HTMLElement>('[data-named]')) each.setAttribute('aria-label', textOfKey(each.dataset.named));
    byId('language').lang = this.language === 'en' ? 'it' : 'en';
    byId('name').textContent = this.fileName;
    this.editor.setLabel(said.editor);
    this.writeExamples();
    this.findingsPane.setLanguage(this.language);
    const { site } = document.documentElement.dataset;
    const documentation = byId<HTMLAnchorElement>('documentation');
    documentation.hidden = !site;
    if (site) documentation.href = this.language === 'it' ? `${site}/docs/it/index.html` : `${site}/index.html`;
  }

  private writeExamples(): void {
    const { said, language } = this;
    byId('examples').replaceChildren(
      element('option', { value: '', selected: true, hidden: true }, said.examples),
      groupOf(said.right, right, 0, language),
      groupOf(said.broken, broken, right.length, language),
    );
  }
}

function groupOf(label: string, examples: Example[], start: number, language: Language): HTMLElement {
  return element('optgroup', { label }, ...examples.map(({ name }, i) => element('option', { value: String(start + i) }, name[language])));
}

try {
  new Page();
} catch (failure) {
  const said = texts[chosenLanguage()];
  document.body.prepend(element('p', { className: 'problem' }, filled(said.unknownBrowser, String(failure))));
  throw failure;
}

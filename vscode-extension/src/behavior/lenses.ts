/** Lenses in diff editors of two programs, whoever has opened them: what each change does on the machine. */
import * as vscode from 'vscode';
import type { Server } from '../server';
import { compare } from './comparing';
import { lensesOf, type Summaries } from './comparison';
import { shownDiffs } from './diffs';

/** How long to wait for another edit, in ms. */
const delay = 200;

export const summaries = (): Summaries => ({
  same: vscode.l10n.t('no difference in what the machine does'),
  sameUpToError: vscode.l10n.t('no difference in what the machine does up to {0} on line {1}, where it stops'),
  one: vscode.l10n.t('1 difference'),
  many: vscode.l10n.t('{0} differences'),
  time: vscode.l10n.t('{0} s'),
});

export class BehaviorLenses implements vscode.CodeLensProvider, vscode.Disposable {
  private readonly changed = new vscode.EventEmitter<void>();
  private readonly subscriptions: vscode.Disposable[];
  private timer: NodeJS.Timeout | null = null;

  readonly onDidChangeCodeLenses = this.changed.event;

  constructor(private readonly server: Server) {
    this.subscriptions = [
      this.changed,
      vscode.languages.registerCodeLensProvider({ language: 'isocnc' }, this),
      vscode.window.tabGroups.onDidChangeTabs(() => this.changeSoon()),
      // An edit of the new program is asked about by VS Code itself.
      vscode.workspace.onDidChangeTextDocument(({ document }) => {
        if ([...shownDiffs().values()].some(({ original }) => original.toString() === document.uri.toString())) this.changeSoon();
      }),
      server.onState((state) => {
        if (state === 'running') this.changeSoon();
      }),
    ];
  }

  async provideCodeLenses(document: vscode.TextDocument, token: vscode.CancellationToken): Promise<vscode.CodeLens[]> {
    const diff = shownDiffs().get(document.uri.toString());
    if (!diff) return [];
    const old = await vscode.workspace.openTextDocument(diff.original);
    if (old.languageId !== 'isocnc') return [];
    // What an edit has overtaken is asked again; without a server there are no lenses.
    const comparison = await compare(this.server, old, document, {}, token).catch(() => null);
    if (!comparison) return [];
    return lensesOf(comparison, summaries(), document.lineCount).map(
      ({ line, title }) => new vscode.CodeLens(new vscode.Range(line, 0, line, 0), { title, command: '' }),
    );
  }

  dispose(): void {
    if (this.timer) clearTimeout(this.timer);
    for (const each of this.subscriptions) each.dispose();
  }

  private changeSoon(): void {
    if (this.timer) clearTimeout(this.timer);
    this.timer = setTimeout(() => this.changed.fire(), delay);
  }
}

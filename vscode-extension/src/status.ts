/** What the status bar shows: the server's state, and the program's cycle time. */
import * as vscode from 'vscode';
import { clock } from '../../toolpath-view/src/format';
import { settings } from './environment';
import type { Server, ServerState } from './server';
import type { ToolpathSource } from './toolpath/source';

const selector = { language: 'isocnc' };
/** Longer programs are run for their cycle time only where their toolpath is shown. */
const maxCharacters = 2_000_000;

export function activate(context: vscode.ExtensionContext, server: Server, source: ToolpathSource): void {
  const language = vscode.languages.createLanguageStatusItem('isocnc.server', selector);
  language.name = 'ISOCNC';
  const show = (state: ServerState) => showState(language, server, state);
  show(server.state);
  const cycle = new CycleTime(source);
  context.subscriptions.push(language, server.onState(show), cycle);
}

function showState(item: vscode.LanguageStatusItem, server: Server, state: ServerState): void {
  const texts: Record<ServerState, [text: string, severity: vscode.LanguageStatusSeverity]> = {
    starting: [vscode.l10n.t('isols is starting'), vscode.LanguageStatusSeverity.Information],
    running: [`isols ${server.version ?? ''}`, vscode.LanguageStatusSeverity.Information],
    stopped: [vscode.l10n.t('isols is not running'), vscode.LanguageStatusSeverity.Error],
    missing: [vscode.l10n.t('isols is missing'), vscode.LanguageStatusSeverity.Error],
    outdated: [vscode.l10n.t('isols {0} is too old', server.version ?? '?'), vscode.LanguageStatusSeverity.Warning],
  };
  [item.text, item.severity] = texts[state];
  item.busy = state === 'starting';
  item.detail = vscode.l10n.t('language server');
  item.command = { command: 'isocnc.restartServer', title: vscode.l10n.t('Restart') };
}

/** The cycle time of the program in the editor, as its last run had it. */
class CycleTime implements vscode.Disposable {
  private readonly item = vscode.window.createStatusBarItem('isocnc.cycleTime', vscode.StatusBarAlignment.Right, 90);
  private readonly subscriptions: vscode.Disposable[];

  constructor(private readonly source: ToolpathSource) {
    this.item.name = vscode.l10n.t('ISOCNC: Cycle Time');
    this.item.command = 'isocnc.showToolpath';
    this.subscriptions = [
      this.item,
      vscode.window.onDidChangeActiveTextEditor(() => this.show()),
      vscode.workspace.onDidChangeConfiguration(() => this.show()),
      source.onUpdate(() => this.show()),
    ];
    this.show();
  }

  dispose(): void {
    for (const each of this.subscriptions) each.dispose();
  }

  private show(): void {
    const document = vscode.window.activeTextEditor?.document;
    if (document?.languageId !== 'isocnc' || !settings(document).get('cycleTime', true)) {
      this.source.watch(this, null);
      this.item.hide();
      return;
    }
    const known = this.source.latest(document.uri);
    const isShort = document.offsetAt(document.lineAt(document.lineCount - 1).range.end) < maxCharacters;
    this.source.watch(this, isShort ? document : null);
    if (!known) {
      this.item.hide();
      return;
    }
    const { facts, seconds } = known;
    const isWhole = facts.ending === 'end';
    this.item.text = `$(${isWhole ? 'watch' : 'warning'}) ${clock(seconds)}`;
    this.item.tooltip = isWhole
      ? vscode.l10n.t('Cycle time on the simulated machine')
      : vscode.l10n.t('Time until the program stops at an error, on line {0}', facts.endLine + 1);
    this.item.show();
  }
}

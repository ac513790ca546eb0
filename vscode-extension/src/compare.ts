/** Compares two programs as isofmt would write them, so that blanks and upper case do not show as differences. */
import * as vscode from 'vscode';
import { nameOf } from './files';
import type { Server } from './server';
import { withEdits, type TextEdit } from './text_edits';

const scheme = 'isocnc-formatted';

export function activate(context: vscode.ExtensionContext, server: Server): void {
  const programs = new FormattedPrograms(server);
  context.subscriptions.push(
    programs,
    vscode.workspace.registerTextDocumentContentProvider(scheme, programs),
    vscode.commands.registerCommand('isocnc.compare', (_clicked?: vscode.Uri, chosen?: vscode.Uri[]) => compare(chosen ?? [])),
  );
}

async function compare(chosen: vscode.Uri[]): Promise<void> {
  if (chosen.length !== 2) {
    await vscode.window.showInformationMessage(vscode.l10n.t('Select two programs in the Explorer first.'));
    return;
  }
  const [left, right] = chosen;
  const name = (uri: vscode.Uri) => vscode.workspace.asRelativePath(uri);
  await vscode.commands.executeCommand('vscode.diff', formatted(left), formatted(right), `${name(left)} ↔ ${name(right)}`);
}

/** The formatted text of a program, under its name; the query holds where the program is. */
function formatted(program: vscode.Uri): vscode.Uri {
  return vscode.Uri.from({ scheme, path: `/${nameOf(program)}`, query: program.toString() });
}

class FormattedPrograms implements vscode.TextDocumentContentProvider, vscode.Disposable {
  private readonly changed = new vscode.EventEmitter<vscode.Uri>();
  private readonly subscription: vscode.Disposable;

  readonly onDidChange = this.changed.event;

  constructor(private readonly server: Server) {
    this.subscription = vscode.workspace.onDidChangeTextDocument(({ document }) => {
      const shown = formatted(document.uri).toString();
      for (const { uri } of vscode.workspace.textDocuments) if (uri.toString() === shown) this.changed.fire(uri);
    });
  }

  /** Without a server, the text as it is. */
  async provideTextDocumentContent({ query }: vscode.Uri): Promise<string> {
    const document = await vscode.workspace.openTextDocument(vscode.Uri.parse(query));
    const text = document.getText();
    const params = { textDocument: { uri: document.uri.toString() }, options: { tabSize: 1, insertSpaces: true } };
    const edits = await this.server.request<TextEdit[] | null>('textDocument/formatting', params).catch(() => null);
    return withEdits(text, edits ?? []);
  }

  dispose(): void {
    this.subscription.dispose();
    this.changed.dispose();
  }
}

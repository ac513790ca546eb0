/** What the server reports of a program, as documents beside it that follow the cursor: the state, the syntax tree. */
import * as vscode from 'vscode';
import type { Server } from './server';

const scheme = 'isocnc';

/** The texts that the server writes about a program, and the titles of their tabs. */
const titles: Record<string, () => string> = {
  state: () => vscode.l10n.t('State'),
  syntax: () => vscode.l10n.t('Syntax Tree'),
};

async function textAbout(server: Server, kind: string, program: vscode.TextDocument, line: number): Promise<string> {
  const uri = `${scheme}://${kind}/?line=${line}&program=${encodeURIComponent(program.uri.toString())}`;
  return (await server.request<{ text: string }>('workspace/textDocumentContent', { uri })).text;
}

export function activate(context: vscode.ExtensionContext, server: Server): void {
  const documents = new VirtualDocuments(server);
  context.subscriptions.push(
    documents,
    vscode.workspace.registerTextDocumentContentProvider(scheme, documents),
    vscode.commands.registerTextEditorCommand('isocnc.showState', ({ document }) => void documents.open('state', document)),
    vscode.commands.registerTextEditorCommand('isocnc.showSyntaxTree', ({ document }) => void documents.open('syntax', document)),
  );
}

class VirtualDocuments implements vscode.TextDocumentContentProvider, vscode.Disposable {
  private readonly changed = new vscode.EventEmitter<vscode.Uri>();
  private readonly subscriptions: vscode.Disposable[];
  private timer: NodeJS.Timeout | null = null;
  /** The program that they are about, and the line. */
  private program: vscode.TextDocument | null = null;
  private line = 0;

  readonly onDidChange = this.changed.event;

  constructor(private readonly server: Server) {
    this.subscriptions = [
      this.changed,
      vscode.window.onDidChangeTextEditorSelection(({ textEditor, selections }) => {
        if (textEditor.document.languageId === 'isocnc') this.follow(textEditor.document, selections[0].active.line);
      }),
      vscode.workspace.onDidChangeTextDocument(({ document }) => {
        if (document === this.program) this.follow(document, Math.min(this.line, document.lineCount - 1));
      }),
    ];
  }

  async open(kind: string, document: vscode.TextDocument): Promise<void> {
    this.program = document;
    this.line = vscode.window.activeTextEditor?.selection.active.line ?? 0;
    const uri = this.uri(kind);
    const shown = await vscode.workspace.openTextDocument(uri);
    this.changed.fire(uri);
    await vscode.window.showTextDocument(shown, { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true, preview: true });
  }

  async provideTextDocumentContent(uri: vscode.Uri): Promise<string> {
    if (!this.program) return '';
    try {
      return await textAbout(this.server, uri.authority, this.program, this.line);
    } catch (error) {
      return (error as Error).message;
    }
  }

  dispose(): void {
    if (this.timer) clearTimeout(this.timer);
    for (const each of this.subscriptions) each.dispose();
  }

  private uri(kind: string): vscode.Uri {
    return vscode.Uri.from({ scheme, authority: kind, path: `/${titles[kind]()}` });
  }

  private follow(document: vscode.TextDocument, line: number): void {
    this.program = document;
    this.line = line;
    if (this.timer) clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      for (const { uri } of vscode.workspace.textDocuments) if (uri.scheme === scheme) this.changed.fire(uri);
    }, 80);
  }
}

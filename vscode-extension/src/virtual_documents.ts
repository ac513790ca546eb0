/** What the server reports of a program, as documents beside it that follow the cursor: the state, the syntax tree. */
import * as vscode from 'vscode';
import { nameOf } from './files';
import type { Server } from './server';
import { stateText, type StateAnswer } from './state_text';

const scheme = 'isocnc';

interface Kind {
  title: () => string;
  text: (server: Server, document: vscode.TextDocument, line: number) => Promise<string>;
}

const kinds: Record<string, Kind> = {
  state: { title: () => vscode.l10n.t('State'), text: state },
  syntax: { title: () => vscode.l10n.t('Syntax Tree'), text: syntaxTree },
};

/** All that stands in the table of states. */
const words: Record<string, () => string> = {
  before: () => vscode.l10n.t('before'),
  after: () => vscode.l10n.t('after'),
  position: () => vscode.l10n.t('position'),
  'machine position': () => vscode.l10n.t('machine position'),
  'workpiece zero': () => vscode.l10n.t('workpiece zero'),
  tool: () => vscode.l10n.t('tool'),
  spindle: () => vscode.l10n.t('spindle'),
  'feed rate': () => vscode.l10n.t('feed rate'),
  motion: () => vscode.l10n.t('motion'),
  'arc plane': () => vscode.l10n.t('arc plane'),
  'face frame': () => vscode.l10n.t('face frame'),
  dimensions: () => vscode.l10n.t('dimensions'),
  units: () => vscode.l10n.t('units'),
  'feed mode': () => vscode.l10n.t('feed mode'),
  interpolation: () => vscode.l10n.t('interpolation'),
  'cutter compensation': () => vscode.l10n.t('cutter compensation'),
  'profile reduction': () => vscode.l10n.t('profile reduction'),
  'No path leads here, or paths differ.': () => vscode.l10n.t('No path leads here, or paths differ.'),
};

async function state(server: Server, document: vscode.TextDocument, line: number): Promise<string> {
  const answer = await server.request<StateAnswer>('isocnc/state', { textDocument: { uri: document.uri.toString() }, line });
  const heading = `${nameOf(document.uri)}:${line + 1}  ${document.lineAt(line).text.trim()}`;
  return stateText(answer, heading, (text) => words[text]());
}

async function syntaxTree(server: Server, document: vscode.TextDocument, line: number): Promise<string> {
  const range = new vscode.Range(line, 0, line, document.lineAt(line).text.length);
  return server.request<string>('isocnc/syntaxTree', { textDocument: { uri: document.uri.toString() }, range });
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

  async open(kind: keyof typeof kinds, document: vscode.TextDocument): Promise<void> {
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
      return await kinds[uri.authority].text(this.server, this.program, this.line);
    } catch (error) {
      return (error as Error).message;
    }
  }

  dispose(): void {
    if (this.timer) clearTimeout(this.timer);
    for (const each of this.subscriptions) each.dispose();
  }

  private uri(kind: string): vscode.Uri {
    return vscode.Uri.from({ scheme, authority: kind, path: `/${kinds[kind].title()}` });
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

/** Programs as they are saved, under their names, beside what the editor has of them. */
import * as vscode from 'vscode';
import { nameOf } from '../files';

const scheme = 'isocnc-saved';

export const savedUri = (program: vscode.Uri) => vscode.Uri.from({ scheme, path: `/${nameOf(program)}`, query: program.toString() });

/** Only comments have characters that depend on the encoding. */
function decoded(bytes: Uint8Array): string {
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder('windows-1252').decode(bytes);
  }
}

export class SavedPrograms implements vscode.TextDocumentContentProvider, vscode.Disposable {
  private readonly changed = new vscode.EventEmitter<vscode.Uri>();
  private readonly subscriptions: vscode.Disposable[];

  readonly onDidChange = this.changed.event;

  constructor() {
    this.subscriptions = [
      this.changed,
      vscode.workspace.registerTextDocumentContentProvider(scheme, this),
      vscode.workspace.onDidSaveTextDocument(({ uri }) => this.changed.fire(savedUri(uri))),
    ];
  }

  async provideTextDocumentContent({ query }: vscode.Uri): Promise<string> {
    return decoded(await vscode.workspace.fs.readFile(vscode.Uri.parse(query)));
  }

  dispose(): void {
    for (const each of this.subscriptions) each.dispose();
  }
}

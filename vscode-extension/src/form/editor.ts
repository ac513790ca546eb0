/** isocnc.json, and the setup of a program, as a form. The text is what counts: each change is an edit of it, which keeps comments and can be undone. */
import { parse, printParseErrorCode, type ParseError } from 'jsonc-parser';
import * as vscode from 'vscode';
import { language } from '../environment';
import { nameOf } from '../files';
import { editsFor } from './json_edits';
import type { FormTexts, FromPage, Path, ToFormPage } from './messages';
import type { Schema } from './schema';

const viewType = 'isocnc.form';

export function activate(context: vscode.ExtensionContext): void {
  const { extensionUri } = context;
  context.subscriptions.push(
    vscode.window.registerCustomEditorProvider(viewType, { resolveCustomTextEditor: (document, panel) => void new Form(document, panel, extensionUri).load() }),
    vscode.commands.registerCommand('isocnc.editAsForm', async (uri?: vscode.Uri) => {
      const file = uri instanceof vscode.Uri ? uri : await nearestFile();
      if (file) await vscode.commands.executeCommand('vscode.openWith', file, viewType);
    }),
  );
}

const isDescription = (uri: vscode.Uri) => nameOf(uri) === 'isocnc.json' || nameOf(uri).endsWith('.setup.json');

/** The file in front, or the one that holds for the program in front; one that the user agrees to make where there is none. */
async function nearestFile(): Promise<vscode.Uri | undefined> {
  const shown = vscode.window.activeTextEditor?.document.uri;
  if (shown && isDescription(shown)) return shown;
  const root = (shown && vscode.workspace.getWorkspaceFolder(shown)?.uri) ?? vscode.workspace.workspaceFolders?.[0]?.uri;
  if (!root) return undefined;
  let folder = shown?.path.startsWith(root.path) ? vscode.Uri.joinPath(shown, '..') : root;
  for (;;) {
    const file = vscode.Uri.joinPath(folder, 'isocnc.json');
    const isThere = await vscode.workspace.fs.stat(file).then(() => true, () => false);
    if (isThere) return file;
    if (folder.path === root.path) break;
    folder = vscode.Uri.joinPath(folder, '..');
  }
  const make = vscode.l10n.t('Make isocnc.json');
  const answer = await vscode.window.showInformationMessage(vscode.l10n.t('This folder has no isocnc.json yet.'), make);
  if (answer !== make) return undefined;
  const file = vscode.Uri.joinPath(root, 'isocnc.json');
  await vscode.workspace.fs.writeFile(file, new TextEncoder().encode('{\n  "machine": {}\n}\n'));
  return file;
}

const texts = (): FormTexts => ({
  add: vscode.l10n.t('Add'),
  remove: vscode.l10n.t('Remove'),
  yes: vscode.l10n.t('yes'),
  no: vscode.l10n.t('no'),
  name: vscode.l10n.t('Name'),
  inText: vscode.l10n.t('Only in the text'),
  broken: vscode.l10n.t('The text is no JSON; mend it there first:'),
  sections: {
    machine: vscode.l10n.t('Machine'),
    tools: vscode.l10n.t('Tools'),
    holders: vscode.l10n.t('Holders'),
    setups: vscode.l10n.t('Setups'),
    setup: vscode.l10n.t('Setup'),
  },
});

class Form {
  private readonly subscriptions: vscode.Disposable[];
  /** Edits come one after the other, each on the text that the one before has left. */
  private last: Promise<unknown> = Promise.resolve();

  constructor(
    private readonly document: vscode.TextDocument,
    private readonly panel: vscode.WebviewPanel,
    private readonly extension: vscode.Uri,
  ) {
    this.subscriptions = [
      panel.webview.onDidReceiveMessage((message: FromPage) => this.receive(message)),
      vscode.workspace.onDidChangeTextDocument((change) => {
        if (change.document === document) void this.show();
      }),
      vscode.languages.onDidChangeDiagnostics(({ uris }) => {
        if (uris.some((uri) => uri.toString() === document.uri.toString())) void this.show();
      }),
      panel.onDidDispose(() => this.subscriptions.forEach((each) => void each.dispose())),
    ];
  }

  async load(): Promise<void> {
    const { webview } = this.panel;
    const place = vscode.Uri.joinPath(this.extension, 'dist');
    webview.options = { enableScripts: true, localResourceRoots: [place] };
    const file = (name: string) => webview.asWebviewUri(vscode.Uri.joinPath(place, name)).toString();
    const policy = `default-src 'none'; script-src ${webview.cspSource}; style-src ${webview.cspSource}`;
    webview.html = `<!doctype html><html lang="${language()}"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}"><meta name="viewport" content="width=device-width">
<title>ISOCNC</title><link rel="stylesheet" href="${file('form.css')}"></head>
<body><div id="problems" role="status"></div><main id="form"></main><script src="${file('form.js')}"></script></body></html>`;
    await this.show();
  }

  private async schema(): Promise<Schema> {
    const base = nameOf(this.document.uri) === 'isocnc.json' ? 'isocnc' : 'isocnc-setup';
    const own = language() === 'it' ? `${base}.schema.it.json` : `${base}.schema.json`;
    const bytes = await vscode.workspace.fs.readFile(vscode.Uri.joinPath(this.extension, own));
    return JSON.parse(new TextDecoder().decode(bytes)) as Schema;
  }

  private async show(): Promise<void> {
    const errors: ParseError[] = [];
    const text = this.document.getText();
    const value: unknown = text.trim() === '' ? {} : parse(text, errors);
    const line = (offset: number) => this.document.positionAt(offset).line + 1;
    const problems =
      errors.length > 0
        ? errors.map(({ error, offset }) => `${line(offset)}: ${printParseErrorCode(error)}`)
        : vscode.languages.getDiagnostics(this.document.uri).map(({ message, range }) => `${range.start.line + 1}: ${message}`);
    const message: ToFormPage = { type: 'show', schema: await this.schema(), value: errors.length > 0 ? null : value, problems, texts: texts() };
    await this.panel.webview.postMessage(message);
  }

  private receive(message: FromPage): void {
    if (message.type === 'ready') void this.show();
    else this.last = this.last.then(() => this.set(message.path, message.value));
  }

  /** A list or an object that loses its last part stays, empty. */
  private async set(path: Path, value: unknown): Promise<void> {
    const { document } = this;
    const text = document.getText();
    if (text.trim() === '') {
      const first = new vscode.WorkspaceEdit();
      first.insert(document.uri, document.positionAt(text.length), '{\n}\n');
      await vscode.workspace.applyEdit(first);
      return this.set(path, value);
    }
    const edit = new vscode.WorkspaceEdit();
    for (const { offset, length, content } of editsFor(text, path, value))
      edit.replace(document.uri, new vscode.Range(document.positionAt(offset), document.positionAt(offset + length)), content);
    await vscode.workspace.applyEdit(edit);
  }
}

/** The toolpath beside the editor: one panel, which shows the program that was last looked at. */
import * as vscode from 'vscode';
import type { Vector } from '../../../toolpath-view/src/toolpath';
import { adviseOpen, currentProgram } from '../current_program';
import { language, settings } from '../environment';
import { nameOf } from '../files';
import type { HiddenLines } from './hidden_lines';
import type { ToPage, ToPanel } from './messages';
import { readPosition } from '../../../toolpath-view/src/machine_position';
import type { KnownToolpath, ToolpathSource } from './source';
import { whole } from '../../../toolpath-view/src/streams';

const viewType = 'isocnc.toolpath';

export function activate(context: vscode.ExtensionContext, source: ToolpathSource, hidden: HiddenLines): void {
  let panel: ToolpathPanel | null = null;
  const adopt = (webview: vscode.WebviewPanel, document: vscode.TextDocument | null) => {
    panel?.dispose();
    const made = (panel = new ToolpathPanel(webview, context.extensionUri, source, hidden));
    webview.onDidDispose(() => {
      if (panel === made) panel = null;
    });
    if (document) made.show(document);
  };
  const open = async (uri?: vscode.Uri) => {
    const wanted = uri instanceof vscode.Uri ? await vscode.workspace.openTextDocument(uri) : undefined;
    const document = wanted ?? currentProgram();
    if (document?.languageId !== 'isocnc') {
      void adviseOpen();
    } else if (panel) {
      panel.reveal();
      panel.show(document);
    } else {
      const beside = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
      const options = { ...ToolpathPanel.options(context.extensionUri), retainContextWhenHidden: true };
      adopt(vscode.window.createWebviewPanel(viewType, vscode.l10n.t('Toolpath'), beside, options), document);
    }
  };
  context.subscriptions.push(
    vscode.commands.registerCommand('isocnc.showToolpath', open),
    vscode.window.registerWebviewPanelSerializer(viewType, {
      deserializeWebviewPanel: (webview) => {
        webview.webview.options = ToolpathPanel.options(context.extensionUri);
        adopt(webview, vscode.window.visibleTextEditors.find(isProgram)?.document ?? null);
        return Promise.resolve();
      },
    }),
    vscode.window.onDidChangeActiveTextEditor((editor) => {
      if (isProgram(editor)) panel?.show(editor.document);
    }),
    vscode.window.tabGroups.onDidChangeTabs(() => void panel?.compare()),
    vscode.window.onDidChangeTextEditorSelection((change) => panel?.follow(change)),
    vscode.workspace.onDidChangeConfiguration((change) => {
      if (change.affectsConfiguration('isocnc')) panel?.configure();
    }),
    vscode.debug.onDidReceiveDebugSessionCustomEvent(({ session, event, body }) => {
      if (event === 'isocnc/position') panel?.pose(session.configuration.program as string, body);
    }),
    { dispose: () => panel?.dispose() },
  );
}

function isProgram(editor: vscode.TextEditor | undefined): editor is vscode.TextEditor {
  return editor?.document.languageId === 'isocnc';
}

class ToolpathPanel implements vscode.Disposable {
  private readonly subscriptions: vscode.Disposable[];
  private readonly passing = vscode.window.createTextEditorDecorationType({
    isWholeLine: true,
    backgroundColor: new vscode.ThemeColor('editor.rangeHighlightBackground'),
    overviewRulerColor: new vscode.ThemeColor('editorOverviewRuler.rangeHighlightForeground'),
    overviewRulerLane: vscode.OverviewRulerLane.Full,
  });
  private document: vscode.TextDocument | null = null;
  private isReady = false;
  private isDisposed = false;
  /** What the page has. */
  private shown: string | null = null;
  /** A line that the page has led to: its selection need not go back there. */
  private picked = -1;
  /** The page shows the old program of a diff, too. */
  private isCompared = false;
  private comparing: vscode.CancellationTokenSource | null = null;

  static options(extension: vscode.Uri): vscode.WebviewOptions {
    return { enableScripts: true, localResourceRoots: [vscode.Uri.joinPath(extension, 'dist')] };
  }

  constructor(
    private readonly panel: vscode.WebviewPanel,
    extension: vscode.Uri,
    private readonly source: ToolpathSource,
    private readonly hidden: HiddenLines,
  ) {
    const icon = (theme: string) => vscode.Uri.joinPath(extension, 'media', `toolpath-${theme}.svg`);
    panel.iconPath = { light: icon('light'), dark: icon('dark') };
    this.subscriptions = [
      panel.webview.onDidReceiveMessage((message: ToPanel) => this.receive(message)),
      panel.onDidDispose(() => this.dispose()),
      source.onUpdate((path) => this.take(path)),
      source.onFailure(({ uri, message }) => {
        if (uri.toString() === this.document?.uri.toString()) this.post({ type: 'problem', message });
      }),
      hidden.onChange((program) => {
        if (program === this.document?.uri.toString()) this.hide();
      }),
      this.passing,
    ];
    void this.load(extension);
  }

  private async load(extension: vscode.Uri): Promise<void> {
    const page = await html(this.panel.webview, extension);
    if (!this.isDisposed) this.panel.webview.html = page;
  }

  show(document: vscode.TextDocument): void {
    if (this.document === document) return;
    this.document = document;
    this.shown = null;
    this.panel.title = vscode.l10n.t('Toolpath: {0}', nameOf(document.uri));
    this.source.watch(this, document);
    this.refresh();
  }

  reveal(): void {
    this.panel.reveal(undefined, true);
  }

  configure(): void {
    this.shown = null;
    this.refresh();
  }

  /** Shows the old program beside this one while a diff of both is in front. */
  async compare(): Promise<void> {
    this.comparing?.cancel();
    const { document, shown } = this;
    if (!document || shown === null) return;
    const comparing = (this.comparing = new vscode.CancellationTokenSource());
    const overlay = await this.source.overlay(document, comparing.token);
    if (comparing.token.isCancellationRequested || this.shown !== shown || !(overlay || this.isCompared)) return;
    this.isCompared = overlay !== null;
    this.post({ type: 'comparison', resultId: shown, overlay });
  }

  follow({ textEditor, selections }: vscode.TextEditorSelectionChangeEvent): void {
    if (textEditor.document !== this.document) return;
    const { start, end } = selections[0];
    // A selection that ends before a line's first character does not hold that line.
    const last = end.character === 0 && end.line > start.line ? end.line - 1 : end.line;
    // While it is debugged, the debugger reports where the tool is.
    if (vscode.debug.activeDebugSession?.configuration.program === this.document.fileName) return;
    const isEcho = start.line === this.picked && last === this.picked;
    this.picked = -1;
    if (!isEcho && settings(textEditor.document).get('toolpath.followCursor', true))
      this.post({ type: 'lines', first: start.line, last });
  }

  pose(program: string, body: unknown): void {
    const position = readPosition(body);
    if (position && this.document?.fileName === program) this.post({ type: 'pose', ...position });
  }

  dispose(): void {
    this.isDisposed = true;
    this.comparing?.cancel();
    this.source.watch(this, null);
    for (const each of this.subscriptions.splice(0)) each.dispose();
    this.panel.dispose();
  }

  private receive(message: ToPanel): void {
    switch (message.type) {
      case 'ready':
        this.isReady = true;
        return this.resend();
      case 'resend':
        return this.resend();
      case 'picked':
        return this.revealLine(message.line);
      case 'passing':
        return this.mark(message.line);
      case 'save':
        return void this.save(message.name, message.content);
    }
  }

  /** Beside the program, unless somebody chooses another place. */
  private async save(name: string, content: Uint8Array): Promise<void> {
    const folder = this.document && vscode.Uri.joinPath(this.document.uri, '..');
    // The name comes from a page, and is a name alone.
    const plain = name.replace(/[\\/]/g, '_');
    const ending = plain.split('.').pop() ?? '';
    const target = await vscode.window.showSaveDialog({
      ...(folder && this.document?.uri.scheme !== 'untitled' && { defaultUri: vscode.Uri.joinPath(folder, plain) }),
      filters: { [ending.toUpperCase()]: [ending] },
    });
    if (!target) return;
    try {
      await vscode.workspace.fs.writeFile(target, content);
    } catch (error) {
      void vscode.window.showErrorMessage(vscode.l10n.t('{0} could not be written: {1}', nameOf(target), (error as Error).message));
    }
  }

  private resend(): void {
    this.shown = null;
    this.refresh();
  }

  private refresh(): void {
    const path = this.document && this.source.latest(this.document.uri);
    if (path) this.take(path);
  }

  private take(path: KnownToolpath): void {
    if (!this.isReady || path.uri.toString() !== this.document?.uri.toString()) return;
    const isNext = this.shown !== null && this.shown === path.previousResultId;
    const { resultId, facts } = path;
    const isFirst = this.shown === null;
    this.shown = resultId;
    this.post({
      type: 'path',
      program: path.uri.toString(),
      resultId,
      previousResultId: isNext ? path.previousResultId : null,
      facts,
      patches: isNext ? path.patches : whole(path),
      language: language(),
    });
    // Another path forgets which of its parts are hidden.
    if (this.hidden.of(path.uri).length > 0) this.hide();
    void this.compare();
    if (!isFirst) return;
    this.post({ type: 'stock', size: settings(this.document).get<Vector | null>('toolpath.stock', null) });
    const editor = this.editor;
    if (editor && settings(this.document).get('toolpath.followCursor', true))
      this.post({ type: 'lines', first: editor.selection.active.line, last: editor.selection.active.line });
  }

  private hide(): void {
    if (this.document && this.shown !== null) this.post({ type: 'hide', lines: this.hidden.of(this.document.uri) });
  }

  private post(message: ToPage): void {
    if (this.isReady) void this.panel.webview.postMessage(message);
  }

  private get editor(): vscode.TextEditor | undefined {
    return vscode.window.visibleTextEditors.find((editor) => editor.document === this.document);
  }

  private revealLine(line: number): void {
    const editor = this.editor;
    if (!editor || line >= editor.document.lineCount) return;
    const place = editor.document.lineAt(line).range.start;
    this.picked = editor.selection.active.line === line ? -1 : line;
    editor.selection = new vscode.Selection(place, place);
    this.mark(line);
  }

  private mark(line: number): void {
    const editor = this.editor;
    if (!editor || line >= editor.document.lineCount) return;
    const range = line < 0 ? [] : [editor.document.lineAt(line).range];
    editor.setDecorations(this.passing, range);
    if (range[0]) editor.revealRange(range[0], vscode.TextEditorRevealType.InCenterIfOutsideViewport);
  }
}

/** The page, with a policy that lets nothing run but its own script. */
async function html(webview: vscode.Webview, extension: vscode.Uri): Promise<string> {
  const nonce = btoa(String.fromCharCode(...crypto.getRandomValues(new Uint8Array(16))));
  const at = (name: string) => webview.asWebviewUri(vscode.Uri.joinPath(extension, 'dist', name)).toString();
  const parts: Record<string, string> = {
    policy: `default-src 'none'; script-src 'nonce-${nonce}'; style-src ${webview.cspSource}; base-uri 'none'; form-action 'none'`,
    style: `<link rel="stylesheet" href="${at('toolpath.css')}">`,
    script: `<script nonce="${nonce}" src="${at('toolpath.js')}"></script>`,
  };
  const page = new TextDecoder().decode(await vscode.workspace.fs.readFile(vscode.Uri.joinPath(extension, 'dist', 'toolpath.html')));
  return page.replace(/\{\{(\w+)\}\}/g, (_, name: string) => parts[name]);
}

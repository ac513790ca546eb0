/** The tree of operations in the Explorer: tools and what each does, with time, path and findings. */
import * as vscode from 'vscode';
import { currentProgram } from '../current_program';
import type { Server } from '../server';
import type { HiddenLines } from '../toolpath/hidden_lines';
import { description, descriptionOfTool, facts, hiddenLines, stillHidden, toolsOf, type Operation, type OperationTexts, type ToolUse } from './operations';

const viewId = 'isocnc.operations';

/** How long to wait for another edit, in ms. */
const delay = 300;

const texts = (): OperationTexts => ({
  operations: vscode.l10n.t('{0} operations'),
  notRun: vscode.l10n.t('not run'),
  path: vscode.l10n.t('path'),
  time: vscode.l10n.t('time'),
  depth: vscode.l10n.t('deepest'),
  extent: vscode.l10n.t('cuts in {0}'),
  removed: vscode.l10n.t('removes'),
  findings: vscode.l10n.t('findings'),
  lines: vscode.l10n.t('lines'),
});

/** An operation by its place in the program, or a tool of several. */
type Node = { place: number } | { use: ToolUse };

export function activate(context: vscode.ExtensionContext, server: Server, hidden: HiddenLines): void {
  const operations = new OperationsView(server, hidden);
  context.subscriptions.push(
    operations,
    vscode.commands.registerCommand('isocnc.showOnlyOperation', (node: Node) => operations.showOnly(node)),
    vscode.commands.registerCommand('isocnc.showAllOperations', () => operations.showAll()),
  );
}

class OperationsView implements vscode.TreeDataProvider<Node>, vscode.Disposable {
  private readonly changed = new vscode.EventEmitter<void>();
  private readonly view: vscode.TreeView<Node>;
  private readonly subscriptions: vscode.Disposable[];
  private timer: NodeJS.Timeout | null = null;
  private asking: vscode.CancellationTokenSource | null = null;
  private program: vscode.TextDocument | null = null;
  private operations: Operation[] = [];
  private tools: ToolUse[] = [];
  private hidden = new Set<number>();

  readonly onDidChangeTreeData = this.changed.event;

  constructor(
    private readonly server: Server,
    private readonly hiddenLines: HiddenLines,
  ) {
    this.view = vscode.window.createTreeView(viewId, { treeDataProvider: this, showCollapseAll: true, manageCheckboxStateManually: true });
    this.subscriptions = [
      this.view,
      this.changed,
      this.view.onDidChangeVisibility(() => this.follow()),
      this.view.onDidChangeCheckboxState(({ items }) => this.check(items)),
      vscode.window.onDidChangeActiveTextEditor(() => this.follow()),
      vscode.workspace.onDidOpenTextDocument(() => this.follow()),
      vscode.workspace.onDidCloseTextDocument(() => this.follow()),
      vscode.workspace.onDidChangeTextDocument(({ document, contentChanges }) => {
        if (document === this.program && contentChanges.length > 0) this.askSoon();
      }),
      // They come after each edit, and after a verification, which knows volumes.
      vscode.languages.onDidChangeDiagnostics(({ uris }) => {
        if (this.program && uris.some((uri) => uri.toString() === this.program?.uri.toString())) this.askSoon();
      }),
      vscode.workspace.onDidSaveTextDocument((document) => {
        if (/(isocnc|\.setup)\.json$/.test(document.fileName)) this.askSoon();
      }),
      server.onState((state) => {
        if (state === 'running') this.askSoon();
      }),
    ];
    this.follow();
  }

  getTreeItem(node: Node): vscode.TreeItem {
    return 'use' in node ? this.toolItem(node.use) : this.operationItem(node.place);
  }

  getChildren(node?: Node): Node[] {
    if (!node) return this.tools.map((use) => (use.operations.length === 1 ? { place: use.operations[0] } : { use }));
    return 'use' in node ? node.use.operations.map((place) => ({ place })) : [];
  }

  showOnly(node: Node): void {
    const shown = new Set(placesOf(node));
    this.hide(new Set(this.operations.map((_, place) => place).filter((place) => !shown.has(place))));
    void vscode.commands.executeCommand('isocnc.showToolpath', this.program?.uri);
  }

  showAll(): void {
    this.hide(new Set());
  }

  dispose(): void {
    if (this.timer) clearTimeout(this.timer);
    this.asking?.cancel();
    for (const each of this.subscriptions) each.dispose();
  }

  private toolItem(use: ToolUse): vscode.TreeItem {
    const item = new vscode.TreeItem(labelOf(use), vscode.TreeItemCollapsibleState.Expanded);
    item.id = `tool ${use.tool}`;
    item.description = descriptionOfTool(use, this.operations, texts());
    item.contextValue = 'operation';
    item.checkboxState = checkbox(use.operations.some((place) => !this.hidden.has(place)));
    return item;
  }

  private operationItem(place: number): vscode.TreeItem {
    const operation = this.operations[place];
    const isOneOfMany = this.tools.some(({ operations }) => operations.length > 1 && operations.includes(place));
    const findings = this.findingsOf(operation);
    const label = isOneOfMany ? operation.name || vscode.l10n.t('line {0}', operation.line + 1) : labelOf(operation);
    const item = new vscode.TreeItem(label);
    item.id = `operation ${place}`;
    item.description = description(operation, texts());
    item.tooltip = tooltipOf(label, facts(operation, findings.length, texts()));
    item.contextValue = 'operation';
    item.checkboxState = checkbox(!this.hidden.has(place));
    item.iconPath = iconOf(findings);
    if (this.program) item.command = { command: 'vscode.open', title: '', arguments: [this.program.uri, { selection: new vscode.Range(operation.line, 0, operation.line, 0) }] };
    return item;
  }

  private findingsOf({ firstLine, lastLine }: Operation): vscode.Diagnostic[] {
    if (!this.program) return [];
    return vscode.languages.getDiagnostics(this.program.uri).filter(({ range }) => range.start.line >= firstLine && range.start.line <= lastLine);
  }

  private check(items: readonly [Node, vscode.TreeItemCheckboxState][]): void {
    const next = new Set(this.hidden);
    for (const [node, state] of items)
      for (const place of placesOf(node)) {
        if (state === vscode.TreeItemCheckboxState.Checked) next.delete(place);
        else next.add(place);
      }
    this.hide(next);
  }

  private hide(hidden: Set<number>): void {
    this.hidden = hidden;
    if (this.program) this.hiddenLines.set(this.program.uri, hiddenLines(this.operations, hidden));
    this.changed.fire();
  }

  /** Another program is looked at. */
  private follow(): void {
    const program = currentProgram() ?? null;
    void vscode.commands.executeCommand('setContext', 'isocnc.hasProgram', program !== null);
    if (program === this.program) {
      if (this.view.visible && this.operations.length === 0) this.askSoon();
      return;
    }
    if (this.program) this.hiddenLines.set(this.program.uri, []);
    this.program = program;
    this.hidden = new Set();
    this.take([]);
    if (program) this.askSoon();
  }

  private take(operations: Operation[]): void {
    this.hidden = stillHidden(this.operations, operations, this.hidden);
    this.operations = operations;
    this.tools = toolsOf(operations);
    this.hide(this.hidden);
  }

  private askSoon(): void {
    if (this.timer) clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.ask(), delay);
  }

  private async ask(): Promise<void> {
    const { program } = this;
    this.asking?.cancel();
    if (!program || !this.view.visible || this.server.state !== 'running') return;
    const asking = (this.asking = new vscode.CancellationTokenSource());
    try {
      const params = { textDocument: { uri: program.uri.toString() } };
      const { operations } = await this.server.request<{ operations: Operation[] }>('isocnc/operations', params, asking.token);
      if (!asking.token.isCancellationRequested && program === this.program) this.take(operations);
    } catch {
      // What an edit has overtaken is asked again.
    }
  }
}

function placesOf(node: Node): number[] {
  return 'use' in node ? node.use.operations : [node.place];
}

function labelOf({ tool, name }: { tool: string; name: string }): string {
  return name ? `${tool} ${name}` : tool;
}

function checkbox(isShown: boolean): vscode.TreeItemCheckboxState {
  return isShown ? vscode.TreeItemCheckboxState.Checked : vscode.TreeItemCheckboxState.Unchecked;
}

function iconOf(findings: vscode.Diagnostic[]): vscode.ThemeIcon {
  if (findings.some(({ severity }) => severity === vscode.DiagnosticSeverity.Error)) return new vscode.ThemeIcon('error', new vscode.ThemeColor('list.errorForeground'));
  if (findings.some(({ severity }) => severity === vscode.DiagnosticSeverity.Warning)) return new vscode.ThemeIcon('warning', new vscode.ThemeColor('list.warningForeground'));
  return new vscode.ThemeIcon('tools');
}

function tooltipOf(title: string, rows: [name: string, value: string][]): vscode.MarkdownString {
  const tooltip = new vscode.MarkdownString();
  tooltip.appendText(title).appendMarkdown('\n\n| | |\n|---|---|\n');
  for (const [name, value] of rows) tooltip.appendMarkdown(`| ${name} | ${value} |\n`);
  return tooltip;
}

/** Programs that are too long for extensions: VS Code shows them, and passes them to no extension. */
import * as vscode from 'vscode';
import type { Environment } from './environment';
import { checkFiles } from './tasks';

/** What VS Code calls a text that it does not synchronize. */
const maxBytes = 50 * 1024 * 1024;

export function activate(context: vscode.ExtensionContext, environment: Environment): void {
  const notified = new Set<string>();
  const look = async () => {
    const input = vscode.window.tabGroups.activeTabGroup.activeTab?.input;
    if (!(input instanceof vscode.TabInputText)) return;
    const { uri } = input;
    if (notified.has(uri.fsPath) || !environment.reaches(uri) || !environment.endings.some((ending) => uri.path.toLowerCase().endsWith(ending))) return;
    if ((await sizeOf(uri)) <= maxBytes || notified.has(uri.fsPath)) return;
    notified.add(uri.fsPath);
    await advise(environment, uri);
  };
  context.subscriptions.push(vscode.window.tabGroups.onDidChangeTabs(look));
  void look();
}

async function sizeOf(uri: vscode.Uri): Promise<number> {
  try {
    return (await vscode.workspace.fs.stat(uri)).size;
  } catch {
    return 0;
  }
}

async function advise(environment: Environment, uri: vscode.Uri): Promise<void> {
  const check = vscode.l10n.t('Check with isolint');
  const name = vscode.workspace.asRelativePath(uri);
  const text = vscode.l10n.t('{0} is above 50 MB. Visual Studio Code does not hand such files to extensions; isolint checks it as a task.', name);
  if ((await vscode.window.showWarningMessage(text, check)) === check) await checkFiles(environment, [uri]);
}

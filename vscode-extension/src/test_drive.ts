/** A folder of programs to play with. */
import * as vscode from 'vscode';

/** The files of the test drive: where extensions come over a network, its folder cannot be listed. */
const names = ['start-here.iso', 'isocnc.json', 'pocket.iso', 'five-axis.iso', 'option.iso'];

/** Files of the test drive with comments, and those that replace them in Italian. */
const italian = { 'start-here.iso': 'l10n/start-here.it.iso', 'isocnc.json': 'l10n/isocnc.it.json' };

/** In the global state: the folder that is just being opened. */
const opened = 'testDrive';

export function activate(context: vscode.ExtensionContext): void {
  context.subscriptions.push(vscode.commands.registerCommand('isocnc.openTestDrive', () => open(context)));
  void start(context);
}

/** The window has been opened for the test drive: its first program is the one to start with. */
async function start({ globalState }: vscode.ExtensionContext): Promise<void> {
  const folder = vscode.workspace.workspaceFolders?.[0].uri;
  if (!folder || globalState.get(opened) !== folder.toString()) return;
  await globalState.update(opened, undefined);
  await vscode.window.showTextDocument(vscode.Uri.joinPath(folder, 'start-here.iso'));
}

async function exists(folder: vscode.Uri): Promise<boolean> {
  return vscode.workspace.fs.stat(folder).then(
    () => true,
    () => false,
  );
}

async function copyTo(target: vscode.Uri, extensionUri: vscode.Uri): Promise<void> {
  if (await exists(target)) return; // It has been opened before, and is the user's by now.
  await vscode.workspace.fs.createDirectory(target);
  const translated: Record<string, string> = vscode.env.language.startsWith('it') ? italian : {};
  for (const name of names) {
    const source = vscode.Uri.joinPath(extensionUri, translated[name] ?? `test-drive/${name}`);
    await vscode.workspace.fs.writeFile(vscode.Uri.joinPath(target, name), await vscode.workspace.fs.readFile(source));
  }
}

async function open({ extensionUri, globalState }: vscode.ExtensionContext): Promise<void> {
  const chosen = await vscode.window.showOpenDialog({
    canSelectFolders: true,
    canSelectFiles: false,
    openLabel: vscode.l10n.t('Copy Test Drive Here'),
    title: vscode.l10n.t('Where shall the test drive be?'),
  });
  if (!chosen) return;
  const target = vscode.Uri.joinPath(chosen[0], 'isocnc-test-drive');
  await copyTo(target, extensionUri);
  await globalState.update(opened, target.toString());
  await vscode.commands.executeCommand('vscode.openFolder', target, { forceNewWindow: !!vscode.workspace.workspaceFolders });
}

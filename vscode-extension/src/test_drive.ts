/** A folder of programs to play with. */
import * as vscode from 'vscode';

export function activate(context: vscode.ExtensionContext): void {
  context.subscriptions.push(
    vscode.commands.registerCommand('isocnc.openTestDrive', () => open(vscode.Uri.joinPath(context.extensionUri, 'test-drive'))),
  );
}

async function open(source: vscode.Uri): Promise<void> {
  const chosen = await vscode.window.showOpenDialog({
    canSelectFolders: true,
    canSelectFiles: false,
    openLabel: vscode.l10n.t('Copy Test Drive Here'),
    title: vscode.l10n.t('Where shall the test drive be?'),
  });
  if (!chosen) return;
  const target = vscode.Uri.joinPath(chosen[0], 'isocnc-test-drive');
  try {
    await vscode.workspace.fs.copy(source, target, { overwrite: false });
  } catch (error) {
    // It has been opened before, and is the user's by now.
    if (!(error instanceof vscode.FileSystemError) || error.code !== 'FileExists') throw error;
  }
  await vscode.commands.executeCommand('vscode.openFolder', target, { forceNewWindow: !!vscode.workspace.workspaceFolders });
}

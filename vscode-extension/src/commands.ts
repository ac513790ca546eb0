/** Commands on the program in the editor. */
import * as vscode from 'vscode';
import * as compare from './compare';
import { toolChangeBeside } from './program_text';
import type { Server } from './server';
import { askForTransformation } from './transform';

export function activate(context: vscode.ExtensionContext, server: Server): void {
  const register = (name: string, run: (editor: vscode.TextEditor) => unknown) =>
    context.subscriptions.push(vscode.commands.registerTextEditorCommand(`isocnc.${name}`, run));
  register('nextToolChange', (editor) => goToToolChange(editor, 1));
  register('previousToolChange', (editor) => goToToolChange(editor, -1));
  register('renumberLines', ({ document }) => ask(server, 'isocnc.renumber', { uri: document.uri.toString() }));
  register('fixProgram', ({ document }) => ask(server, 'isocnc.fixAll', { uri: document.uri.toString() }));
  register('restartFromHere', ({ document, selection }) =>
    ask(server, 'isocnc.restart', { uri: document.uri.toString(), line: selection.active.line }),
  );
  register('transformProgram', async ({ document }) => {
    const transformation = await askForTransformation();
    if (transformation) await ask(server, 'isocnc.transform', { uri: document.uri.toString(), ...transformation });
  });
  compare.activate(context, server);
  context.subscriptions.push(
    vscode.commands.registerCommand('isocnc.restartServer', () => server.restart()),
    vscode.commands.registerCommand('isocnc.showOutput', () => server.showOutput()),
  );
}

function goToToolChange(editor: vscode.TextEditor, direction: 1 | -1): void {
  const { document, selection } = editor;
  const line = toolChangeBeside(document.lineCount, (i) => document.lineAt(i).text, selection.active.line, direction);
  if (line === null) {
    const where = direction > 0 ? vscode.l10n.t('There is no tool change below.') : vscode.l10n.t('There is no tool change above.');
    void vscode.window.setStatusBarMessage(where, 3000);
    return;
  }
  const place = new vscode.Position(line, 0);
  editor.selection = new vscode.Selection(place, place);
  editor.revealRange(new vscode.Range(place, place), vscode.TextEditorRevealType.InCenterIfOutsideViewport);
}

/** Has the server carry a command out; it edits by itself. */
async function ask(server: Server, command: string, argument: object): Promise<void> {
  try {
    await server.request('workspace/executeCommand', { command, arguments: [argument] });
  } catch (error) {
    await vscode.window.showErrorMessage((error as Error).message);
  }
}

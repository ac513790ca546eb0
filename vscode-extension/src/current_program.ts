/** The program that is meant where none is named: that in the editor; else, in a walkthrough or the like, that looked at before. */
import * as vscode from 'vscode';
import type { Environment } from './environment';

let last: vscode.TextDocument | undefined;
let reaches: (uri: vscode.Uri) => boolean;

export function activate(context: vscode.ExtensionContext, environment: Environment): void {
  reaches = (uri) => environment.reaches(uri);
  const look = (editor: vscode.TextEditor | undefined) => {
    if (editor?.document.languageId === 'isocnc') last = editor.document;
  };
  look(vscode.window.activeTextEditor);
  context.subscriptions.push(
    vscode.window.onDidChangeActiveTextEditor(look),
    vscode.workspace.onDidOpenTextDocument(() => look(vscode.window.activeTextEditor)),
  );
}

/** Undefined where no program is open. */
export function currentProgram(): vscode.TextDocument | undefined {
  const document = vscode.window.activeTextEditor?.document;
  if (document?.languageId === 'isocnc') return document;
  return last && !last.isClosed ? last : undefined;
}

/** Whether a program lies in a file; if it does not, or there is none, the user gets a message. */
export function isInFile(program: vscode.TextDocument | undefined): program is vscode.TextDocument {
  if (program?.languageId !== 'isocnc') {
    void adviseOpen();
    return false;
  }
  if (reaches(program.uri)) return true;
  void vscode.window.showInformationMessage(vscode.l10n.t('Save the program first: it is run from its file.'));
  return false;
}

export async function adviseOpen(): Promise<void> {
  const open = vscode.l10n.t('Open Test Drive');
  if ((await vscode.window.showInformationMessage(vscode.l10n.t('Open an ISOCNC program first.'), open)) === open)
    await vscode.commands.executeCommand('isocnc.openTestDrive');
}

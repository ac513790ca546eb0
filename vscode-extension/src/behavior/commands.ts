/** Commands that compare what two programs, or two versions of one, do on the machine: a diff editor with lenses. */
import * as vscode from 'vscode';
import { currentProgram, adviseOpen } from '../current_program';
import { endingsOf } from '../environment';
import { nameOf, uriOf } from '../files';
import type { Server } from '../server';
import { compare } from './comparing';
import { summary } from './comparison';
import { compareFolders } from './folders';
import { headOf } from './git';
import { BehaviorLenses, summaries } from './lenses';
import { SavedPrograms, savedUri } from './saved';

export function activate(context: vscode.ExtensionContext, server: Server): void {
  const endings = endingsOf(context);
  context.subscriptions.push(
    new BehaviorLenses(server),
    new SavedPrograms(),
    vscode.commands.registerCommand('isocnc.compareWithHead', (uri?: vscode.Uri) => run(() => compareWithHead(server, uri))),
    vscode.commands.registerCommand('isocnc.compareWithSaved', (uri?: vscode.Uri) => run(() => compareWithSaved(server, uri))),
    vscode.commands.registerCommand('isocnc.compareWithFile', (uri?: vscode.Uri, chosen?: vscode.Uri[]) =>
      run(() => compareWithFile(server, endings, uri, chosen)),
    ),
    vscode.commands.registerCommand('isocnc.compareFolders', (folder?: vscode.Uri, chosen?: vscode.Uri[]) =>
      run(() => compareFolders(endings, (...diff) => show(server, ...diff), folder, chosen)),
    ),
    vscode.commands.registerCommand('isocnc.runToDifference', () => run(() => runToDifference(endings))),
  );
}

/** The user gets a message of what goes wrong. */
async function run(command: () => Promise<void>): Promise<void> {
  try {
    await command();
  } catch (error) {
    await vscode.window.showErrorMessage((error as Error).message);
  }
}

/** The program that is meant: that of the menu, or else that in the editor. Undefined after advice to the user. */
async function programOf(uri: vscode.Uri | undefined): Promise<vscode.Uri | undefined> {
  const program = uri ?? currentProgram()?.uri;
  if (!program) await adviseOpen();
  return program;
}

/** Shows the diff, and says so where the machine does the same. */
async function show(server: Server, old: vscode.Uri, now: vscode.Uri, title: string): Promise<void> {
  await vscode.commands.executeCommand('vscode.diff', old, now, title);
  const [oldProgram, newProgram] = await Promise.all([old, now].map((each) => vscode.workspace.openTextDocument(each)));
  const comparison = await compare(server, oldProgram, newProgram);
  if (comparison.same) void vscode.window.showInformationMessage(`${title}: ${summary(comparison, summaries())}`);
}

async function compareWithHead(server: Server, uri?: vscode.Uri): Promise<void> {
  const program = await programOf(uri);
  if (!program) return;
  const head = await headOf(program);
  await show(server, head.uri, program, `${nameOf(program)} (HEAD ↔ ${vscode.l10n.t('now')})`);
}

async function compareWithSaved(server: Server, uri?: vscode.Uri): Promise<void> {
  const program = await programOf(uri);
  if (!program) return;
  if (program.scheme === 'untitled') throw new Error(vscode.l10n.t('{0} has never been saved.', nameOf(program)));
  await show(server, savedUri(program), program, `${nameOf(program)} (${vscode.l10n.t('saved')} ↔ ${vscode.l10n.t('now')})`);
}

async function chooseFile(beside: vscode.Uri, endings: readonly string[], title: string): Promise<vscode.Uri | undefined> {
  const chosen = await vscode.window.showOpenDialog({
    defaultUri: beside.scheme === 'untitled' ? undefined : vscode.Uri.joinPath(beside, '..'),
    filters: { ISOCNC: endings.map((ending) => ending.slice(1)), [vscode.l10n.t('All Files')]: ['*'] },
    title,
  });
  return chosen?.[0];
}

/** Two that are selected in the Explorer; or the program and one that is chosen, which is the old one. */
async function compareWithFile(server: Server, endings: readonly string[], uri?: vscode.Uri, chosen?: vscode.Uri[]): Promise<void> {
  const program = await programOf(uri);
  if (!program) return;
  const other = chosen?.length === 2 ? chosen.find((each) => each.toString() !== program.toString()) : await chooseFile(program, endings, vscode.l10n.t('Compare Behavior with'));
  if (other) await show(server, other, program, `${nameOf(other)} ↔ ${nameOf(program)}`);
}

/** Has the debugger run to where its program comes to do something else than in HEAD, or than another one. */
async function runToDifference(endings: readonly string[]): Promise<void> {
  const session = vscode.debug.activeDebugSession;
  if (session?.type !== 'isocnc') return;
  const program = uriOf(String(session.configuration.program));
  const head = { label: 'HEAD', description: vscode.l10n.t('{0} as it was committed last', nameOf(program)) };
  const file = { label: vscode.l10n.t('File...') };
  const placeHolder = vscode.l10n.t('Run to the first difference from');
  const chosen = await vscode.window.showQuickPick([head, file], { placeHolder });
  if (!chosen) return;
  if (chosen === head) {
    const { text } = await headOf(program);
    await session.customRequest('isocnc/runToDifference', { text, name: `${nameOf(program)} (HEAD)` });
    return;
  }
  const other = await chooseFile(program, endings, placeHolder);
  if (!other) return;
  const text = (await vscode.workspace.openTextDocument(other)).getText();
  await session.customRequest('isocnc/runToDifference', { text, name: nameOf(other) });
}

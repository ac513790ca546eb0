/** isorun: runs a program in the terminal, and writes its plot. */
import * as vscode from 'vscode';
import { currentProgram, isInFile } from './current_program';
import { language, type Environment, type Program } from './environment';
import { programTask, verify } from './tasks';

/** What a code lens says about its place. */
export interface Place {
  uri: string;
  line: number;
}

/** The program that a command is about, saved; null where there is none that lies in a file. */
export async function programOf(place?: Place | vscode.Uri): Promise<vscode.TextDocument | null> {
  const uri = place instanceof vscode.Uri ? place : place ? vscode.Uri.parse(place.uri) : undefined;
  const document = uri ? await vscode.workspace.openTextDocument(uri) : currentProgram();
  if (!isInFile(document)) return null;
  return !document.isDirty || (await document.save()) ? document : null;
}

export function activate(context: vscode.ExtensionContext, environment: Environment): void {
  context.subscriptions.push(
    vscode.commands.registerCommand('isocnc.run', (place?: Place | vscode.Uri, chosen?: vscode.Uri[]) => run(environment, place, chosen)),
    vscode.commands.registerCommand('isocnc.exportPlot', (place?: Place | vscode.Uri) => exportPlot(environment, place)),
  );
}

const isFolder = async (uri: vscode.Uri) => ((await vscode.workspace.fs.stat(uri)).type & vscode.FileType.Directory) !== 0;

/** One program; or all in a folder, or that are selected in the Explorer, with what the machine shows of each among the problems. */
async function run(environment: Environment, place?: Place | vscode.Uri, chosen?: vscode.Uri[]): Promise<void> {
  if (place instanceof vscode.Uri && ((chosen?.length ?? 0) > 1 || (await isFolder(place)))) return verify(environment, place, chosen);
  const program = await programOf(place);
  const isorun = program && (await environment.need('isorun'));
  if (!isorun) return;
  await vscode.tasks.executeTask(
    programTask({ type: 'isocnc', command: 'isorun', arguments: [isorun.pathOf(program.uri)] }, isorun, 'isorun'),
  );
}

async function exportPlot(environment: Environment, place?: Place | vscode.Uri): Promise<void> {
  const program = await programOf(place);
  const isorun = program && (await environment.need('isorun'));
  if (!isorun) return;
  const target = await vscode.window.showSaveDialog({
    defaultUri: program.uri.with({ path: program.uri.path.replace(/\.[^./]*$/, '') + '.html' }),
    filters: { HTML: ['html'], SVG: ['svg'] },
    title: vscode.l10n.t('Export Plot'),
  });
  if (!target) return;
  const written = await vscode.window.withProgress(
    { location: vscode.ProgressLocation.Notification, title: vscode.l10n.t('Drawing {0}...', vscode.workspace.asRelativePath(target)) },
    () => plot(isorun, program.uri, target),
  );
  if (written !== null) {
    await vscode.window.showErrorMessage(written);
    return;
  }
  const open = vscode.l10n.t('Open');
  const done = vscode.l10n.t('Written: {0}', vscode.workspace.asRelativePath(target));
  if ((await vscode.window.showInformationMessage(done, open)) === open) await vscode.env.openExternal(target);
}

/** What went wrong, or null. A program that an error stops has a plot as well. */
async function plot(isorun: Program, program: vscode.Uri, target: vscode.Uri): Promise<string | null> {
  const { status, complaints } = await isorun.run(['--lang', language(), '--plot', isorun.pathOf(target), isorun.pathOf(program)]);
  return status <= 1 ? null : complaints;
}

/** Tasks: isolint over the workspace or a program of any size, isorun. */
import * as vscode from 'vscode';
import { adviseOpen, currentProgram } from './current_program';
import { language, type Environment, type Program } from './environment';
import type { ProgramName } from './programs';

export interface Definition extends vscode.TaskDefinition {
  type: 'isocnc';
  command: Extract<ProgramName, 'isolint' | 'isorun' | 'isofmt'>;
  arguments?: string[];
}

const matchers = ['$isolint', '$isolint-it-errors', '$isolint-it-warnings', '$isolint-it-notes'];

/** A task that runs a program, and shows what isolint says among the problems. */
export function programTask(definition: Definition, program: Program, name: string): vscode.Task {
  const isCheck = definition.command === 'isolint';
  const options = ['--lang', language(), ...(isCheck ? ['--format', 'concise', '--color', 'never'] : [])];
  const task = new vscode.Task(
    definition,
    vscode.workspace.workspaceFolders?.[0] ?? vscode.TaskScope.Global,
    name,
    'isocnc',
    program.execution(options, definition.arguments ?? []),
    isCheck && !program.listsProblems ? matchers : [],
  );
  task.group = isCheck ? vscode.TaskGroup.Test : undefined;
  task.presentationOptions = { clear: true, showReuseMessage: false, reveal: vscode.TaskRevealKind.Always };
  return task;
}

export function activate(context: vscode.ExtensionContext, environment: Environment): void {
  context.subscriptions.push(
    vscode.tasks.registerTaskProvider('isocnc', {
      provideTasks: () => tasks(environment),
      resolveTask: ({ definition, name }) => {
        const wanted = definition as Definition;
        const program = environment.find(wanted.command);
        return program ? programTask(wanted, program, name) : undefined;
      },
    }),
    vscode.commands.registerCommand('isocnc.check', (clicked?: vscode.Uri, chosen?: vscode.Uri[]) => check(environment, clicked, chosen)),
  );
}

/** Runs what is chosen in the Explorer on the simulated machine, and lists what only that shows, too. */
export const verify = (environment: Environment, clicked?: vscode.Uri, chosen?: vscode.Uri[]) => check(environment, clicked, chosen, ['--verify']);

/** Checks what is chosen in the Explorer, files and folders, or else the program in the editor, as it is saved. */
async function check(environment: Environment, clicked?: vscode.Uri, chosen?: vscode.Uri[], options: string[] = []): Promise<void> {
  const uris = chosen?.length ? chosen : [clicked ?? currentProgram()?.uri].filter((uri) => uri !== undefined);
  if (!uris.length) return adviseOpen();
  const files = uris.filter((uri) => environment.reaches(uri));
  if (!files.length) {
    await vscode.window.showInformationMessage(vscode.l10n.t('Save the program first: it is run from its file.'));
    return;
  }
  const isMeant = ({ scheme, path }: vscode.Uri) => files.some((file) => file.scheme === scheme && `${path}/`.startsWith(`${file.path}/`));
  for (const document of vscode.workspace.textDocuments) if (document.isDirty && isMeant(document.uri)) await document.save();
  await checkFiles(environment, files, options);
}

function tasks(environment: Environment): vscode.Task[] {
  const isolint = environment.find('isolint');
  const isorun = environment.find('isorun');
  const workspace: Definition = { type: 'isocnc', command: 'isolint' };
  const check: Definition = { type: 'isocnc', command: 'isolint', arguments: ['${file}'] };
  const run: Definition = { type: 'isocnc', command: 'isorun', arguments: ['${file}'] };
  return [
    ...(isolint ? [programTask(workspace, isolint, vscode.l10n.t('check all programs')), programTask(check, isolint, vscode.l10n.t('check this program'))] : []),
    ...(isorun ? [programTask(run, isorun, vscode.l10n.t('run this program'))] : []),
  ];
}

/** Checks files and folders by isolint itself; what it finds is listed among the problems. */
export async function checkFiles(environment: Environment, files: vscode.Uri[], options: string[] = []): Promise<void> {
  const isolint = await environment.need('isolint');
  if (isolint)
    await vscode.tasks.executeTask(programTask({ type: 'isocnc', command: 'isolint', arguments: [...options, ...files.map((file) => isolint.pathOf(file))] }, isolint, 'isolint'));
}

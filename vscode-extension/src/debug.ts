/** Debugging by isodap: started by F5, by buttons, from a line; MDI blocks. */
import * as vscode from 'vscode';
import { currentProgram, isInFile } from './current_program';
import { absolute, completed } from './debug_configuration';
import type { Environment } from './environment';
import { uriOf } from './files';
import { expressionAt } from './program_text';
import { programOf, type Place } from './simulator';

const type = 'isocnc';

export function activate(context: vscode.ExtensionContext, environment: Environment): void {
  const provider = new ConfigurationProvider(environment);
  context.subscriptions.push(
    vscode.debug.registerDebugAdapterDescriptorFactory(type, {
      createDebugAdapterDescriptor: () => {
        const isodap = environment.find('isodap');
        // The provider has shown a message already.
        if (!isodap) throw new Error(vscode.l10n.t('There is no isodap.'));
        return isodap.debugAdapter();
      },
    }),
    vscode.debug.registerDebugConfigurationProvider(type, provider),
    vscode.debug.registerDebugConfigurationProvider(
      type,
      { provideDebugConfigurations: () => [provider.ofOpenProgram()] },
      vscode.DebugConfigurationProviderTriggerKind.Dynamic,
    ),
    vscode.languages.registerEvaluatableExpressionProvider({ language: 'isocnc' }, { provideEvaluatableExpression: expression }),
    vscode.commands.registerCommand('isocnc.debugProgram', (place?: Place | vscode.Uri) => debugProgram(place)),
    vscode.commands.registerCommand('isocnc.debug', (place?: Place | vscode.Uri) => debugFrom(place)),
    vscode.commands.registerCommand('isocnc.runMdi', runMdi),
  );
}

const configurationName = () => vscode.l10n.t('Debug program');

class ConfigurationProvider implements vscode.DebugConfigurationProvider {
  constructor(private readonly environment: Environment) {}

  ofOpenProgram(): vscode.DebugConfiguration {
    return { type, request: 'launch', name: configurationName(), program: '${file}', stopOnEntry: true };
  }

  provideDebugConfigurations(): vscode.DebugConfiguration[] {
    return [this.ofOpenProgram()];
  }

  resolveDebugConfiguration(
    _folder: vscode.WorkspaceFolder | undefined,
    configuration: vscode.DebugConfiguration,
  ): vscode.DebugConfiguration | null | undefined {
    const document = currentProgram();
    const program = document && this.environment.reaches(document.uri) ? document.fileName : null;
    const complete = completed(configuration, program, configurationName());
    if (!complete) isInFile(document);
    return complete ?? undefined;
  }

  async resolveDebugConfigurationWithSubstitutedVariables(
    folder: vscode.WorkspaceFolder | undefined,
    configuration: vscode.DebugConfiguration,
  ): Promise<vscode.DebugConfiguration | null | undefined> {
    const from = (folder ?? vscode.workspace.workspaceFolders?.[0])?.uri;
    const complete = absolute(configuration, from && ((file) => vscode.Uri.joinPath(from, file).fsPath));
    const program = complete.program!;
    if (!(await exists(program))) {
      void vscode.window.showErrorMessage(vscode.l10n.t('There is no program {0}.', program));
      return undefined;
    }
    return (await this.environment.need('isodap')) ? complete : undefined;
  }
}

async function exists(program: string): Promise<boolean> {
  try {
    await vscode.workspace.fs.stat(uriOf(program));
    return true;
  } catch {
    return false;
  }
}

async function debugProgram(place?: Place | vscode.Uri): Promise<void> {
  const program = await programOf(place);
  if (program) await start(program, { stopOnEntry: true });
}

/** Starts at a line, in the state that a run to it has. */
async function debugFrom(place?: Place | vscode.Uri): Promise<void> {
  const program = await programOf(place);
  const isLens = place && !(place instanceof vscode.Uri);
  const line = isLens ? place.line : (vscode.window.activeTextEditor?.selection.active.line ?? 0);
  if (program) await start(program, { startAtLine: line + 1 });
}

const start = (program: vscode.TextDocument, how: { stopOnEntry: true } | { startAtLine: number }) =>
  vscode.debug.startDebugging(vscode.workspace.getWorkspaceFolder(program.uri), {
    type,
    request: 'launch',
    name: configurationName(),
    program: program.fileName,
    ...how,
  });

async function runMdi(): Promise<void> {
  const session = vscode.debug.activeDebugSession;
  if (session?.type !== type) return;
  const expression = await vscode.window.showInputBox({
    prompt: vscode.l10n.t('A block that the paused machine carries out; G909 ends MDI'),
    placeHolder: 'G00 Z100',
  });
  if (!expression) return;
  try {
    const frame = vscode.debug.activeStackItem;
    const frameId = frame instanceof vscode.DebugStackFrame ? frame.frameId : undefined;
    const { result } = (await session.customRequest('evaluate', { expression, context: 'repl', frameId })) as { result: string };
    vscode.debug.activeDebugConsole.appendLine(`${expression}\n${result}`);
  } catch (error) {
    await vscode.window.showErrorMessage((error as Error).message);
  }
}

/** What a hover asks the debugger for. */
function expression(document: vscode.TextDocument, { line, character }: vscode.Position): vscode.EvaluatableExpression | undefined {
  const found = expressionAt(document.lineAt(line).text, character);
  return found ? new vscode.EvaluatableExpression(new vscode.Range(line, found.start, line, found.end), found.name) : undefined;
}

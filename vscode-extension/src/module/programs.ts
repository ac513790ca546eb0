/** The programs of the WebAssembly module: for editors in a browser, and for computers that have no native ones. */
import type { LanguageClientOptions } from 'vscode-languageclient';
import * as vscode from 'vscode';
import type { Program as Command } from '../../../web/src/module';
import { endingsOf, type Outcome, type Program } from '../environment';
import type { ProgramName } from '../programs';
import { ModuleClient } from './client';
import { ModuleDebugAdapter } from './debug_adapter';
import { filesOfArguments, filesOfFolder, write } from './files';
import { pathOf } from './names';
import { Problems, type Contributions } from './problems';
import { Workers, type StartWorker } from './worker';

export class ModulePrograms {
  private readonly workers: Workers;
  private readonly endings: readonly string[];
  private readonly problems: Problems;

  constructor(context: vscode.ExtensionContext, startWorker: StartWorker) {
    this.workers = new Workers(context.extensionUri, startWorker);
    this.endings = endingsOf(context);
    const { contributes } = context.extension.packageJSON as { contributes: Contributions };
    this.problems = new Problems(contributes);
    context.subscriptions.push(
      this.problems,
      vscode.workspace.onDidOpenTextDocument(({ uri }) => this.problems.forget(uri)),
    );
  }

  find(name: ProgramName): Program {
    const run = (args: readonly string[]) => this.run(name as Command, args);
    return {
      place: 'isocnc.wasm',
      listsProblems: !isOnComputer(),
      pathOf,
      reaches: ({ scheme }) => vscode.workspace.fs.isWritableFileSystem(scheme) !== undefined,
      run,
      execution: (options, args) =>
        new vscode.CustomExecution((definition) => {
          const named = (definition.arguments as string[] | undefined) ?? args;
          return Promise.resolve(new ModuleTerminal(() => this.runTask(name as Command, [...options, ...named])));
        }),
      connect: (options: LanguageClientOptions) => new ModuleClient(this.workers, this.endings, options),
      debugAdapter: () => new vscode.DebugAdapterInlineImplementation(new ModuleDebugAdapter(this.workers)),
    };
  }

  private async runTask(command: Command, args: readonly string[]): Promise<Outcome> {
    const outcome = await this.run(command, args);
    if (command === 'isolint' && !isOnComputer()) this.problems.show(outcome.output, workingDirectory());
    return outcome;
  }

  /** In the workspace's folder; of which a command that names no file gets the programs. */
  private async run(command: Command, args: readonly string[]): Promise<Outcome> {
    const workspace = vscode.workspace.workspaceFolders?.[0]?.uri;
    const folder = workingDirectory();
    const named = await filesOfArguments(args, folder, this.endings);
    const files = workspace && Object.keys(named.files).length === 0 ? await filesOfFolder(workspace, this.endings) : named.files;
    const done = await this.workers.run(files, { program: command, args: named.args, folder });
    await write(done.files ?? {});
    return done;
  }
}

const isOnComputer = () => (vscode.workspace.workspaceFolders?.[0]?.uri.scheme ?? 'file') === 'file';

/** The workspace's folder, as the module names it. */
function workingDirectory(): string {
  const workspace = vscode.workspace.workspaceFolders?.[0]?.uri;
  return workspace ? pathOf(workspace) : '/';
}

/** VS Code takes a terminal that ends sooner for one that has not started, and says so. */
const shortestTerminal = 600; // ms.

/** A terminal that shows what a command prints. */
class ModuleTerminal implements vscode.Pseudoterminal {
  private readonly written = new vscode.EventEmitter<string>();
  private readonly closed = new vscode.EventEmitter<number>();

  readonly onDidWrite = this.written.event;
  readonly onDidClose = this.closed.event;

  private opened = 0;

  constructor(private readonly run: () => Promise<Outcome>) {}

  open(): void {
    this.opened = Date.now();
    void this.run().then(
      ({ status, output, complaints }) => this.end(output + complaints, status),
      (error: unknown) => this.end(`${String(error)}\n`, 2),
    );
  }

  close(): void {}

  private end(text: string, status: number): void {
    this.written.fire(text.replaceAll('\n', '\r\n'));
    setTimeout(() => this.closed.fire(status), Math.max(0, this.opened + shortestTerminal - Date.now()));
  }
}

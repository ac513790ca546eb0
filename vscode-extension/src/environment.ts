/** The programs as this editor, its settings and this system have them. */
import type { BaseLanguageClient, LanguageClientOptions } from 'vscode-languageclient';
import * as vscode from 'vscode';
import type { ProgramName } from './programs';

export const settings = (scope?: vscode.ConfigurationScope) => vscode.workspace.getConfiguration('isocnc', scope);

export type Language = 'en' | 'it';

/** The language that messages shall be in. */
export function language(): Language {
  const wanted = settings().get<string>('language', 'auto');
  if (wanted === 'en' || wanted === 'it') return wanted;
  return vscode.env.language.startsWith('it') ? 'it' : 'en';
}

/** What we read of our package.json. */
interface Manifest {
  version: string;
  contributes: { languages: { extensions?: string[] }[] };
}

export interface Outcome {
  status: number;
  output: string;
  complaints: string;
}

/** A program that can be run: a native one, or one of the WebAssembly module. */
export interface Program {
  /** Where it is, for the log. */
  readonly place: string;
  /** Whether its tasks list problems by themselves: problem matchers find only files of the computer. */
  readonly listsProblems: boolean;
  /** The name of a file among its arguments. */
  pathOf(uri: vscode.Uri): string;
  /** Whether it can read documents of the URI's scheme, once they are saved. */
  reaches(uri: vscode.Uri): boolean;
  run(args: readonly string[]): Promise<Outcome>;
  /** What a task does: options that are ours, then the arguments of its definition. */
  execution(options: readonly string[], args: readonly string[]): vscode.ProcessExecution | vscode.CustomExecution;
  /** Of a language server. */
  connect(options: LanguageClientOptions): BaseLanguageClient;
  /** Of a debugger. */
  debugAdapter(): vscode.DebugAdapterDescriptor;
}

export type FindProgram = (name: ProgramName) => Program | null;

const manifestOf = ({ extension }: vscode.ExtensionContext) => extension.packageJSON as Manifest;

/** What the names of programs for the machine end in. */
export const endingsOf = (context: vscode.ExtensionContext) => manifestOf(context).contributes.languages.flatMap(({ extensions = [] }) => extensions);

export class Environment {
  constructor(
    private readonly context: vscode.ExtensionContext,
    readonly find: FindProgram,
  ) {}

  get version(): string {
    return manifestOf(this.context).version;
  }

  get endings(): string[] {
    return endingsOf(this.context);
  }

  /** The program; if there is none, the user gets a message. */
  async need(name: ProgramName): Promise<Program | null> {
    const program = this.find(name);
    if (!program) await adviseMissing(name);
    return program;
  }

  /** Whether a document can be run from where it is saved. */
  reaches(uri: vscode.Uri): boolean {
    return this.find('isorun')?.reaches(uri) ?? uri.scheme === 'file';
  }
}

/** Reports that a program is missing, and where its folder is set. */
export async function adviseMissing(name: ProgramName): Promise<void> {
  const folder = settings().get('path', '');
  const message = folder
    ? vscode.l10n.t('There is no {0} in {1}, the folder that isocnc.path names.', name, folder)
    : vscode.l10n.t('{0} did not come with this extension, and is not on the PATH. Name its folder in isocnc.path.', name);
  const open = vscode.l10n.t('Open Settings');
  if ((await vscode.window.showErrorMessage(message, open)) === open)
    await vscode.commands.executeCommand('workbench.action.openSettings', 'isocnc.path');
}

/** The programs as this editor, its settings and this system have them. */
import { accessSync, constants, statSync } from 'node:fs';
import { delimiter } from 'node:path';
import * as vscode from 'vscode';
import { findProgram, type ProgramName } from './programs';

function isExecutable(file: string): boolean {
  try {
    accessSync(file, constants.X_OK);
    return statSync(file).isFile();
  } catch {
    return false;
  }
}

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

export class Environment {
  constructor(private readonly context: vscode.ExtensionContext) {}

  get version(): string {
    return this.manifest.version;
  }

  /** What the names of programs end in. */
  get endings(): string[] {
    return this.manifest.contributes.languages.flatMap(({ extensions = [] }) => extensions);
  }

  find(name: ProgramName): string | null {
    const places = {
      configured: settings().get('path', ''),
      bundled: this.context.asAbsolutePath('bin'),
      path: (process.env.PATH ?? '').split(delimiter),
    };
    return findProgram(name, places, isExecutable);
  }

  /** The program; if there is none, the user gets a message. */
  async need(name: ProgramName): Promise<string | null> {
    const file = this.find(name);
    if (!file) await adviseMissing(name);
    return file;
  }

  private get manifest(): Manifest {
    return this.context.extension.packageJSON as Manifest;
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

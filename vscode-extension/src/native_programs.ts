/** The programs as files of this computer, in processes. */
import { execFile } from 'node:child_process';
import { accessSync, constants, statSync } from 'node:fs';
import { delimiter } from 'node:path';
import { promisify } from 'node:util';
import * as vscode from 'vscode';
import { LanguageClient } from 'vscode-languageclient/node';
import { language, settings, type Outcome, type Program } from './environment';
import { findProgram, type ProgramName } from './programs';

function isExecutable(file: string): boolean {
  try {
    accessSync(file, constants.X_OK);
    return statSync(file).isFile();
  } catch {
    return false;
  }
}

export function findNative(name: ProgramName, context: vscode.ExtensionContext): Program | null {
  const places = {
    configured: settings().get('path', ''),
    bundled: context.asAbsolutePath('bin'),
    path: (process.env.PATH ?? '').split(delimiter),
  };
  const file = findProgram(name, places, isExecutable);
  return file ? nativeProgram(file) : null;
}

function nativeProgram(file: string): Program {
  return {
    place: file,
    listsProblems: false,
    pathOf: ({ fsPath }) => fsPath,
    reaches: ({ scheme }) => scheme === 'file',
    run: (args) => run(file, args),
    execution: (options, args) => new vscode.ProcessExecution(file, [...options, ...args]),
    connect: (options) => new LanguageClient('isocnc', 'ISOCNC', { command: file, args: ['--stdio'] }, options),
    debugAdapter: () => new vscode.DebugAdapterExecutable(file, ['--lang', language()]),
  };
}

async function run(file: string, args: readonly string[]): Promise<Outcome> {
  try {
    const { stdout, stderr } = await promisify(execFile)(file, args, { maxBuffer: 1 << 26 });
    return { status: 0, output: stdout, complaints: stderr };
  } catch (error) {
    const { code, stdout = '', stderr } = error as { code: number | string; stdout?: string; stderr?: string };
    return { status: typeof code === 'number' ? code : 2, output: stdout, complaints: stderr || String(error) };
  }
}

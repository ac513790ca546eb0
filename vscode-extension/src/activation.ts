/** The extension, with the programs that its entry finds. */
import * as vscode from 'vscode';
import * as behavior from './behavior/commands';
import * as commands from './commands';
import * as currentProgram from './current_program';
import * as debug from './debug';
import { Environment, type FindProgram } from './environment';
import * as form from './form/editor';
import * as largeFiles from './large_files';
import * as operations from './operations/view';
import { Server } from './server';
import * as simulator from './simulator';
import * as status from './status';
import * as tasks from './tasks';
import * as testDrive from './test_drive';
import { HiddenLines } from './toolpath/hidden_lines';
import { ToolpathSource } from './toolpath/source';
import * as toolpath from './toolpath/panel';
import * as virtualDocuments from './virtual_documents';

let server: Server | null = null;

export function start(context: vscode.ExtensionContext, find: FindProgram): void {
  const environment = new Environment(context, find);
  server = new Server(environment);
  const source = new ToolpathSource(server);
  const hidden = new HiddenLines();
  context.subscriptions.push(server, source, hidden);
  currentProgram.activate(context, environment);
  behavior.activate(context, server);
  commands.activate(context, server);
  debug.activate(context, environment);
  form.activate(context);
  largeFiles.activate(context, environment);
  operations.activate(context, server, hidden);
  simulator.activate(context, environment);
  status.activate(context, server, source);
  tasks.activate(context, environment);
  testDrive.activate(context);
  toolpath.activate(context, source, hidden);
  virtualDocuments.activate(context, server);
  // F5 and all commands wait until this has returned; a server may never answer, and its advice wait for the user.
  void server.start();
}

export async function stop(): Promise<void> {
  await server?.stop();
}

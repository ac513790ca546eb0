/** The debug adapter isodap in the module. */
import * as vscode from 'vscode';
import { language } from '../environment';
import { uriOf, uriOfPath } from '../files';
import { changed, configurationsAbove, setupBeside, type Files } from './files';
import { pathOf, withPaths } from './names';
import type { Port, Workers } from './worker';

interface Request {
  type: string;
  command?: string;
  arguments?: Record<string, unknown>;
}

/** As VS Code names a file to debuggers. */
function nameFor(path: string): string {
  const uri = uriOfPath(path);
  return uri.scheme === 'file' ? uri.fsPath : uri.toString();
}

export class ModuleDebugAdapter implements vscode.DebugAdapter {
  private readonly sent = new vscode.EventEmitter<vscode.DebugProtocolMessage>();
  private readonly port: Promise<Port>;
  /** One message after another, also where one waits for its files. */
  private last: Promise<void> = Promise.resolve();
  private isOver = false;

  readonly onDidSendMessage = this.sent.event;

  constructor(workers: Workers) {
    this.port = workers.serve(
      { server: 'isodap', language: language() },
      (message) => this.sent.fire(withPaths(message, nameFor) as vscode.DebugProtocolMessage),
      (message) => this.fail(message),
    );
    this.port.catch((error: unknown) => this.fail(String(error)));
  }

  handleMessage(message: vscode.DebugProtocolMessage): void {
    this.last = this.last.then(() => this.forward(message as unknown as Request)).catch((error: unknown) => this.fail(String(error)));
  }

  dispose(): void {
    this.isOver = true;
    void this.port.then((port) => port.terminate(), () => undefined);
    this.sent.dispose();
  }

  private async forward(request: Request): Promise<void> {
    const port = await this.port;
    if (this.isOver) return;
    const named = withPaths(request, (path) => pathOf(uriOf(path))) as Request;
    if (request.command === 'launch') await this.prepare(port, named.arguments ?? {});
    // A second launch, with what the files hold by now.
    else if (request.command === 'restart') await this.prepare(port, (named.arguments?.arguments ?? {}) as Record<string, unknown>);
    port.postMessage(named);
  }

  /** Gives the module the files of a launch, and the launch their names in the module. */
  private async prepare(port: Port, launch: Record<string, unknown>): Promise<void> {
    const files: Files[] = [];
    for (const key of ['program', 'machine']) {
      const name = launch[key];
      if (typeof name !== 'string' || !name) continue;
      const uri = uriOf(name);
      launch[key] = pathOf(uri);
      files.push(await changed(uri));
      if (key === 'program') files.push(await configurationsAbove(uri), await setupBeside(uri));
    }
    port.postMessage({ files: Object.assign({}, ...files) as Files });
  }

  private fail(message: string): void {
    if (this.isOver) return;
    const event = (name: string, body: object) => this.sent.fire({ type: 'event', seq: 0, event: name, body });
    event('output', { category: 'stderr', output: `${message}\n` });
    event('terminated', {});
  }
}

/** The language client of isols in the module. */
import {
  AbstractMessageReader,
  AbstractMessageWriter,
  BaseLanguageClient,
  FileChangeType,
  State,
  type DataCallback,
  type Disposable,
  type LanguageClientOptions,
  type Message,
  type MessageTransports,
} from 'vscode-languageclient';
import * as vscode from 'vscode';
import { settings } from '../environment';
import { uriOfPath } from '../files';
import { changed, configurationsAbove, filesOfFolder, setupBeside, watch, type Files } from './files';
import { messageFromModule, messageToModule, pathOf } from './names';
import type { Port, Workers } from './worker';

class Reader extends AbstractMessageReader {
  private callback: DataCallback | null = null;

  listen(callback: DataCallback): Disposable {
    this.callback = callback;
    return { dispose: () => (this.callback = null) };
  }

  take(message: unknown): void {
    this.callback?.(messageFromModule(message) as Message);
  }

  fail(message: string): void {
    this.fireError(new Error(message));
    this.fireClose();
  }
}

class Writer extends AbstractMessageWriter {
  constructor(private readonly port: Port) {
    super();
  }

  write(message: Message): Promise<void> {
    this.port.postMessage(messageToModule(message));
    return Promise.resolve();
  }

  end(): void {}
}

export class ModuleClient extends BaseLanguageClient {
  private port: Port | null = null;
  private readonly watched: vscode.Disposable[] = [];
  /** Programs that have been opened, and their folders. */
  private readonly known = new Set<string>();
  /** The paths of files that the server has got. */
  private readonly sent = new Set<string>();

  constructor(
    private readonly workers: Workers,
    private readonly endings: readonly string[],
    options: LanguageClientOptions,
  ) {
    super('isocnc', 'ISOCNC', {
      ...options,
      middleware: {
        workspace: {
          // The server reads the file anew, which has to be there.
          didChangeWatchedFile: async (event, next) => {
            const uri = vscode.Uri.parse(event.uri);
            // Of shapes it reads only those that a file names which it has got.
            if (this.sent.has(pathOf(uri)) || !/\.(?:stl|stock)$/i.test(uri.path)) this.send(await changed(uri));
            await next(event);
          },
        },
      },
    });
  }

  override async stop(timeout?: number): Promise<void> {
    try {
      await super.stop(timeout);
    } finally {
      if (this.state === State.Stopped) this.close();
    }
  }

  protected override async createMessageTransports(): Promise<MessageTransports> {
    this.close();
    const reader = new Reader();
    const files = await this.firstFiles();
    this.port = await this.workers.serve({ server: 'isols' }, (message) => reader.take(message), (message) => reader.fail(message));
    this.send(files);
    this.watched.push(
      watch(
        this.endings,
        (path) => this.sent.has(path),
        (files) => this.send(files),
      ),
      vscode.workspace.onDidOpenTextDocument((document) => void this.lookAbove(document)),
      vscode.workspace.onDidChangeWorkspaceFolders(({ added }) => void this.addFolders(added)),
    );
    return { reader, writer: new Writer(this.port) };
  }

  private close(): void {
    for (const each of this.watched.splice(0)) each.dispose();
    this.port?.terminate();
    this.port = null;
    this.known.clear();
    this.sent.clear();
  }

  private send(files: Files): void {
    for (const path of Object.keys(files)) this.sent.add(path);
    this.port?.postMessage({ files });
  }

  /** What the server needs before it reads the first program. */
  private async firstFiles(): Promise<Files> {
    const folders = await this.filesOf(vscode.workspace.workspaceFolders ?? []);
    const above = await Promise.all(vscode.workspace.textDocuments.map((document) => this.newAbove(document)));
    return Object.assign({}, ...folders, ...above) as Files;
  }

  /** Programs that are not open are read where the user wants to know of them. */
  private filesOf(folders: readonly vscode.WorkspaceFolder[]): Promise<Files[]> {
    const all = settings().get('workspaceDiagnostics', false);
    return Promise.all(folders.map(({ uri }) => (all ? filesOfFolder(uri, this.endings) : configurationsAbove(vscode.Uri.joinPath(uri, '-')))));
  }

  private async addFolders(folders: readonly vscode.WorkspaceFolder[]): Promise<void> {
    for (const files of await this.filesOf(folders)) this.send(files);
  }

  private async newAbove({ languageId, uri }: vscode.TextDocument): Promise<Files> {
    if (languageId !== 'isocnc' || uri.scheme === 'untitled') return {};
    const isNew = (place: vscode.Uri) => !this.known.has(place.toString()) && this.known.add(place.toString());
    const found: Promise<Files>[] = [];
    if (isNew(vscode.Uri.joinPath(uri, '..'))) found.push(configurationsAbove(uri));
    if (isNew(uri)) found.push(setupBeside(uri));
    return Object.assign({}, ...(await Promise.all(found))) as Files;
  }

  /** The server may have read the program already, and takes it up again with what has been found. */
  private async lookAbove(document: vscode.TextDocument): Promise<void> {
    const files = await this.newAbove(document);
    const added = Object.keys(files).filter((path) => files[path] && !this.sent.has(path));
    if (added.length === 0) return;
    this.send(files);
    const changes = added.map((path) => ({ uri: uriOfPath(path).toString(), type: FileChangeType.Created }));
    await this.sendNotification('workspace/didChangeWatchedFiles', { changes });
  }
}

/** The language server: started, watched, ended, started again. */
import * as vscode from 'vscode';
import {
  State,
  type BaseLanguageClient,
  type ClientCapabilities,
  type FeatureState,
  type StaticFeature,
} from 'vscode-languageclient';
import { isInDiff } from './behavior/diffs';
import { adviseMissing, language, settings, type Environment } from './environment';
import { isOlder } from './versions';

export type ServerState = 'starting' | 'running' | 'stopped' | 'missing' | 'outdated';

/** What we do for code lenses of the server: it offers them to editors that name these commands. */
class CommandsFeature implements StaticFeature {
  fillClientCapabilities(capabilities: ClientCapabilities): void {
    capabilities.experimental = { ...(capabilities.experimental as object | undefined), commands: { commands: ['isocnc.run', 'isocnc.debug'] } };
  }
  initialize(): void {}
  getState(): FeatureState {
    return { kind: 'static' };
  }
  clear(): void {}
}

/** What the server gets when it starts, and not again. */
const atStart = ['isocnc.path', 'isocnc.workspaceDiagnostics'];

function serverSettings() {
  const all = settings();
  const inlayHints: unknown = all.inlayHints;
  const workspaceDiagnostics: unknown = all.workspaceDiagnostics;
  const verify: unknown = all.verify;
  return { language: language(), inlayHints, workspaceDiagnostics, verify };
}

export class Server implements vscode.Disposable {
  private readonly output = vscode.window.createOutputChannel('ISOCNC', { log: true });
  private readonly trace = vscode.window.createOutputChannel('ISOCNC: Trace');
  private readonly changed = new vscode.EventEmitter<ServerState>();
  private client: BaseLanguageClient | null = null;
  private current: ServerState = 'stopped';
  /** How often it has been asked to start anew. */
  private restarts = 0;
  private readonly subscriptions: vscode.Disposable[] = [];

  readonly onState = this.changed.event;

  constructor(private readonly environment: Environment) {
    this.subscriptions.push(
      vscode.workspace.onDidChangeConfiguration((change) => {
        if (atStart.some((setting) => change.affectsConfiguration(setting))) void this.restart();
        else if (change.affectsConfiguration('isocnc')) void this.configure();
      }),
    );
  }

  get state(): ServerState {
    return this.current;
  }
  get version(): string | undefined {
    return this.client?.initializeResult?.serverInfo?.version;
  }

  async start(): Promise<void> {
    const isols = this.environment.find('isols');
    if (!isols) {
      this.setState('missing');
      void adviseMissing('isols');
      return;
    }
    this.output.info(`isols: ${isols.place}`);
    const client = isols.connect({
      documentSelector: [{ language: 'isocnc' }, { pattern: '**/isocnc.json' }, { pattern: '**/*.setup.json' }],
      initializationOptions: serverSettings(),
      outputChannel: this.output,
      traceOutputChannel: this.trace,
      markdown: { supportHtml: false },
      // A diff has lenses of its own, about what has changed.
      middleware: { provideCodeLenses: (document, token, next) => (isInDiff(document) ? [] : next(document, token)) },
    });
    client.registerFeature(new CommandsFeature());
    client.onDidChangeState(({ newState }) => {
      if (this.client === client && newState !== State.Running) this.setState(newState === State.Starting ? 'starting' : 'stopped');
      else if (this.client === client) void this.greet();
    });
    this.client = client;
    try {
      await client.start();
      // Given up while it was starting, when it could not be ended.
      if (this.client !== client) await client.dispose();
    } catch (error) {
      this.output.error(String(error));
      if (this.client !== client) return;
      this.setState('stopped');
      await this.adviseStopped();
    }
  }

  /** Of several in a row, as when a path is typed into the settings, the last one starts the server. */
  async restart(): Promise<void> {
    const restart = ++this.restarts;
    const client = this.client;
    this.client = null;
    this.setState('stopped');
    await client?.dispose().catch((error: unknown) => this.output.warn(String(error)));
    if (restart === this.restarts) await this.start();
  }

  /** Asks the server; waits for it where it is just starting. Throws what it answers. */
  async request<Result>(method: string, params: object, token?: vscode.CancellationToken): Promise<Result> {
    if (!this.client || this.current === 'missing') throw new Error(vscode.l10n.t('The language server is not running.'));
    await this.client.start();
    // A token that is undefined would be sent as a parameter.
    return token ? this.client.sendRequest<Result>(method, params, token) : this.client.sendRequest<Result>(method, params);
  }

  showOutput(): void {
    this.output.show();
  }

  async stop(): Promise<void> {
    await this.client?.dispose();
  }

  dispose(): void {
    for (const each of [...this.subscriptions, this.changed, this.output, this.trace]) each.dispose();
  }

  private setState(state: ServerState): void {
    this.current = state;
    this.changed.fire(state);
  }

  /** The server runs; it may be another one than we have been made for. */
  private async greet(): Promise<void> {
    const wanted = this.environment.version;
    if (!isOlder(this.version, wanted)) {
      this.setState('running');
      return;
    }
    this.setState('outdated');
    const message = vscode.l10n.t('isols {0} is older than this extension, {1}: some of it will not work.', this.version ?? '?', wanted);
    const open = vscode.l10n.t('Open Settings');
    if ((await vscode.window.showWarningMessage(message, open)) === open)
      await vscode.commands.executeCommand('workbench.action.openSettings', 'isocnc.path');
  }

  private async adviseStopped(): Promise<void> {
    const show = vscode.l10n.t('Show Output');
    if ((await vscode.window.showErrorMessage(vscode.l10n.t('The language server could not be started.'), show)) === show)
      this.showOutput();
  }

  private async configure(): Promise<void> {
    if (this.client?.state === State.Running)
      await this.client.sendNotification('workspace/didChangeConfiguration', { settings: { isocnc: serverSettings() } });
  }
}

/** isols in a worker: requests, and the program that it knows. */
import { ModuleWorker } from './module_worker';
import type { Capabilities, Diagnostic, TextEdit, WorkspaceEdit } from './protocol';
import type { Language } from './texts';

const uri = 'file:///program/program.iso';
export const textDocument = { uri };

/** The edits of the program. */
export const editsOf = (edit: WorkspaceEdit | undefined) => edit?.changes?.[uri] ?? [];

interface Message {
  id?: number | string;
  method?: string;
  params?: unknown;
  result?: unknown;
  error?: { code: number; message: string };
}

/** What the server answers instead of a result. */
export class RequestError extends Error {
  constructor(
    readonly code: number,
    message: string,
  ) {
    super(message);
  }
  /** An edit has overtaken the request, or it has been cancelled. */
  get isOutdated(): boolean {
    return this.code === -32801 || this.code === -32802 || this.code === -32800;
  }
}

const clientCapabilities = {
  general: { positionEncodings: ['utf-16'] },
  textDocument: {
    publishDiagnostics: { relatedInformation: true, codeDescriptionSupport: true, tagSupport: { valueSet: [1, 2] } },
    hover: { contentFormat: ['markdown', 'plaintext'] },
    completion: { completionItem: { snippetSupport: true, documentationFormat: ['markdown', 'plaintext'], resolveSupport: { properties: ['documentation'] } } },
    codeAction: {
      codeActionLiteralSupport: { codeActionKind: { valueSet: ['quickfix', 'refactor', 'source'] } },
      isPreferredSupport: true,
      dataSupport: true,
      resolveSupport: { properties: ['edit'] },
    },
    semanticTokens: { requests: { full: true }, tokenTypes: [], tokenModifiers: [], formats: ['relative'] },
    documentSymbol: { hierarchicalDocumentSymbolSupport: true },
    rename: { prepareSupport: true },
    inlayHint: {},
    signatureHelp: { signatureInformation: { documentationFormat: ['markdown', 'plaintext'] } },
  },
};

export class LanguageServer {
  /** The findings of the program as it is now. */
  onFindings: (findings: Diagnostic[]) => void = () => undefined;

  private readonly waiting = new Map<number, { resolve: (result: unknown) => void; reject: (error: Error) => void }>();
  private last = 0;
  private version = 1;

  private constructor(private readonly worker: ModuleWorker) {
    worker.onMessage = (message) => this.receive(message as Message);
  }

  /** Calls `fail` where the server stops working. */
  static async start(text: string, language: Language, fail: (message: string) => void): Promise<[LanguageServer, Capabilities]> {
    const worker = await ModuleWorker.start('isols', '');
    worker.onFailure = fail;
    const server = new LanguageServer(worker);
    const { capabilities } = await server.request<{ capabilities: Capabilities }>('initialize', {
      processId: null,
      rootUri: null,
      locale: language,
      capabilities: clientCapabilities,
      initializationOptions: { isocnc: settings(language) },
    });
    server.notify('initialized', {});
    server.notify('textDocument/didOpen', { textDocument: { uri, languageId: 'isocnc', version: server.version, text } });
    return [server, capabilities];
  }

  request<Result>(method: string, params: object, signal?: AbortSignal): Promise<Result> {
    const id = ++this.last;
    signal?.addEventListener('abort', () => this.notify('$/cancelRequest', { id }), { once: true });
    return new Promise<Result>((resolve, reject) => {
      this.waiting.set(id, { resolve: resolve as (result: unknown) => void, reject });
      this.worker.send({ jsonrpc: '2.0', id, method, params });
    });
  }

  /** Changes of the program; one without a range is all of it. */
  change(contentChanges: { range?: TextEdit['range']; text: string }[]): void {
    this.notify('textDocument/didChange', { textDocument: { uri, version: ++this.version }, contentChanges });
  }

  setLanguage(language: Language): void {
    this.notify('workspace/didChangeConfiguration', { settings: { isocnc: settings(language) } });
  }

  /** The text of `isolint --explain`. */
  async explanationOf(code: string, language: Language): Promise<string> {
    const { output, complaints } = await this.worker.run('isolint', ['--explain', code, '--lang', language, '--color', 'never']);
    return output || complaints;
  }

  private notify(method: string, params: object): void {
    this.worker.send({ jsonrpc: '2.0', method, params });
  }

  private receive({ id, method, params, result, error }: Message): void {
    if (method === undefined) {
      const request = this.waiting.get(Number(id));
      this.waiting.delete(Number(id));
      if (error) request?.reject(new RequestError(error.code, error.message));
      else request?.resolve(result);
    } else if (id !== undefined) {
      // It asks for the settings, or to register something: none of it is here.
      const answer = method === 'workspace/configuration' ? [null] : null;
      this.worker.send({ jsonrpc: '2.0', id, result: answer });
    } else if (method === 'textDocument/publishDiagnostics') {
      const { version, diagnostics } = params as { version?: number; diagnostics: Diagnostic[] };
      if (version === undefined || version === this.version) this.onFindings(diagnostics);
    }
  }
}

const settings = (language: Language) => ({ language });

/**
 * A web worker that holds one server: `isols` or `isodap`. The first message starts it; then each message with `files`
 * changes the files that the server sees, each with `run` runs a command, and every other one goes to the server, whose
 * messages come back as objects.
 */
import { Conversation } from './conversation';
import makeModule from './glue';
import type { Module, ModuleOptions, Program, Server } from './module';
import { filesIn, runOnText, type Outcome } from './streams';
import { throwToPage } from './uncaught';

export interface Start {
  server: Server;
  /** The content of isocnc.wasm, where it is, or what has been compiled of it. */
  wasm: ArrayBuffer | string | WebAssembly.Module;
  /** en, it, or empty for what the client asks for. */
  language?: string;
}

export interface Changes {
  /** The new content of files by absolute paths; null where a file has been removed. */
  files: Record<string, Uint8Array | string | null>;
}

/** A command to run in the same module; the answer is an Answer with the same number as `run`. */
export interface Command {
  run: number;
  program: Program;
  args: readonly string[];
  /** Its standard input. */
  text?: string;
  /** Its working directory; with one, the answer has the files that the command has written. */
  folder?: string;
}

export interface Answer extends Outcome {
  run: number;
  /** By absolute paths. */
  files?: Record<string, Uint8Array>;
}

const scope = globalThis as unknown as {
  onmessage: ((event: { data: unknown }) => void) | null;
  postMessage(message: unknown): void;
  close(): void;
};

function change(module: Module, { files }: Changes): void {
  for (const [path, content] of Object.entries(files)) {
    if (content !== null) {
      module.FS.mkdirTree(path.slice(0, path.lastIndexOf('/')) || '/');
      module.FS.writeFile(path, content);
    } else if (module.FS.analyzePath(path).exists) {
      module.FS.unlink(path);
    }
  }
}

const isEqual = (one: Uint8Array, other: Uint8Array | undefined) => one.length === other?.length && one.every((byte, i) => byte === other[i]);

function answer(module: Module, { run, program, args, text, folder }: Command): Answer {
  if (folder === undefined) return { run, ...runOnText(module, program, args, text) };
  module.FS.mkdirTree(folder);
  module.FS.chdir(folder);
  const before = filesIn(module.FS);
  const outcome = runOnText(module, program, args, text);
  const written = [...filesIn(module.FS)].filter(([path, content]) => !isEqual(content, before.get(path)));
  return { run, ...outcome, files: Object.fromEntries(written) };
}

const isMessageWith = (member: string, data: unknown) => typeof data === 'object' && data !== null && member in data;

function instanceOf(compiled: WebAssembly.Module): Promise<Module> {
  return new Promise((resolve, reject) => {
    const instantiateWasm: ModuleOptions['instantiateWasm'] = (imports, receive) => {
      WebAssembly.instantiate(compiled, imports).then(receive).catch(reject);
      return {};
    };
    makeModule({ instantiateWasm }).then(resolve, reject);
  });
}

async function moduleOf(wasm: Start['wasm']): Promise<Module> {
  if (wasm instanceof WebAssembly.Module) return instanceOf(wasm);
  return makeModule({ wasmBinary: typeof wasm === 'string' ? await (await fetch(wasm)).arrayBuffer() : wasm });
}

async function start({ server, wasm, language }: Start): Promise<(data: unknown) => void> {
  const module = await moduleOf(wasm);
  const conversation = new Conversation(
    module,
    server,
    language ?? '',
    (body) => scope.postMessage(JSON.parse(body)),
    () => scope.close(),
  );
  return (data) => {
    if (isMessageWith('files', data)) change(module, data as Changes);
    else if (isMessageWith('run', data)) scope.postMessage(answer(module, data as Command));
    else conversation.send(JSON.stringify(data));
  };
}

// What arrives before the module is there waits.
let started: Promise<(data: unknown) => void> | null = null;
scope.onmessage = ({ data }) => {
  if (started) void started.then((take) => take(data), () => undefined);
  else {
    started = start(data as Start);
    started.catch(throwToPage);
  }
};

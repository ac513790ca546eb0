/** The WebAssembly module as Emscripten's loader gives it: what web/module.cpp exports, and the files it sees. */

export type Program = 'isolint' | 'isofmt' | 'isorun' | 'isodiff';
export type Server = 'isols' | 'isodap';

/** A file that is open; what is read from it and written to it goes through `stream_ops`, what is known of it through `node_ops`. */
export interface OpenFile {
  fd: number;
  stream_ops: Record<'read' | 'write', (stream: OpenFile, bytes: Int8Array, offset: number, length: number) => number>;
  node: { node_ops: { getattr(node: OpenFile['node']): { size: number } } };
}

/** The files that the module sees: in a page they are in memory. */
export interface Files {
  cwd(): string;
  chdir(path: string): void;
  mkdirTree(path: string): void;
  writeFile(path: string, content: string | Uint8Array): void;
  readFile(path: string): Uint8Array;
  readFile(path: string, options: { encoding: 'utf8' }): string;
  unlink(path: string): void;
  rename(from: string, to: string): void;
  analyzePath(path: string): { exists: boolean };
  readdir(path: string): string[];
  stat(path: string): { mode: number };
  isDir(mode: number): boolean;
  open(path: string, flags: string): OpenFile;
  close(stream: OpenFile): void;
  streams: OpenFile[];
}

export interface Module {
  readonly FS: Files;
  readonly ENV: Record<string, string | undefined>;
  readonly HEAPU32: Uint32Array;
  allocateUTF8(text: string): number;
  _free(address: number): void;
  _malloc(size: number): number;
  _isocnc_run(count: number, texts: number): number;
  _isocnc_begin(server: number, language: number): number;
  _isocnc_receive(conversation: number, body: number): void;
  _isocnc_work(conversation: number, milliseconds: number): number;
  _isocnc_end(conversation: number): number;
  /** Gets the messages of servers, as JSON. */
  onmessage?: (conversation: number, body: string) => void;
}

export interface ModuleOptions {
  wasmBinary?: ArrayBuffer | Uint8Array;
  /** Makes an instance of a module that is compiled already, instead of `wasmBinary`, and hands it to `receive`. */
  instantiateWasm?: (imports: WebAssembly.Imports, receive: (instance: WebAssembly.Instance) => void) => object;
  /** Whether a standard stream is a terminal; otherwise none is. */
  isTerminal?: (descriptor: number) => boolean;
  preRun?: ((module: Module) => void)[];
}

export type MakeModule = (options: ModuleOptions) => Promise<Module>;

/** Calls `use` with texts in the module's memory. */
export function withTexts<Result>(module: Module, texts: readonly string[], use: (...addresses: number[]) => Result): Result {
  const addresses = texts.map((text) => module.allocateUTF8(text));
  try {
    return use(...addresses);
  } finally {
    for (const address of addresses) module._free(address);
  }
}

/** Runs a command, and returns its exit status. */
export function run(module: Module, program: Program, args: readonly string[]): number {
  const texts = [program, ...args];
  return withTexts(module, texts, (...addresses) => {
    const list = module._malloc(4 * (texts.length + 1));
    module.HEAPU32.set([...addresses, 0], list / 4);
    try {
      return module._isocnc_run(texts.length, list);
    } finally {
      module._free(list);
    }
  });
}

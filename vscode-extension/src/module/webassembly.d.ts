/** What the worker's types (web/src/worker.ts) name of WebAssembly. TypeScript knows it as a part of the DOM, which extensions do not have. */
declare namespace WebAssembly {
  class Module {
    constructor(bytes: ArrayBuffer);
    readonly [Symbol.toStringTag]: string;
  }
  class Instance {
    constructor(module: Module, imports?: Imports);
    readonly exports: Record<string, unknown>;
  }
  type Imports = Record<string, Record<string, unknown>>;
  function instantiate(module: Module, imports?: Imports): Promise<Instance>;
}

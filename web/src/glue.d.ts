import type { MakeModule } from './module';

/** Emscripten's loader of the module, isocnc.mjs: files in memory, for pages and for Node.js. */
declare const makeModule: MakeModule;
export default makeModule;

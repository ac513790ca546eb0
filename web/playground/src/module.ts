/**
 * The WebAssembly module and the script of its worker. This is a script of its own, before that of the page: the module is unpacked and compiled beside
 * the page, while the page makes its editor. A page from a disk may fetch nothing, but it may have scripts.
 */
import packed from 'embedded:module';
import unpacker from 'embedded:unpacker';
import worker from 'embedded:worker';

export interface EmbeddedModule {
  compiled: Promise<WebAssembly.Module>;
  /** Makes a worker that waits for a server to start (web/src/worker.ts). */
  makeWorker: () => Worker;
}

declare global {
  var isocncModule: EmbeddedModule | undefined;
}

const workerOf = (script: string) => new Worker(URL.createObjectURL(new Blob([script], { type: 'text/javascript' })));

function compile(): Promise<WebAssembly.Module> {
  return new Promise((resolve, reject) => {
    const made = workerOf(unpacker);
    made.onmessage = ({ data }: MessageEvent<WebAssembly.Module>) => {
      made.terminate();
      resolve(data);
    };
    made.onerror = (event) => {
      event.preventDefault();
      reject(new Error(event.message));
    };
    made.postMessage(packed, [packed.buffer]);
  });
}

globalThis.isocncModule = { compiled: compile(), makeWorker: () => workerOf(worker) };
// The page says what went wrong as soon as it is there.
globalThis.isocncModule.compiled.catch(() => undefined);

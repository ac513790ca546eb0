/** The entry under Node.js, on desktops and remote computers: native programs, or else the WebAssembly module if it came with the extension. */
import { existsSync } from 'node:fs';
import { Worker } from 'node:worker_threads';
import * as vscode from 'vscode';
import { start, stop } from './activation';
import { settings } from './environment';
import { ModulePrograms } from './module/programs';
import type { StartWorker } from './module/worker';
import { findNative } from './native_programs';

/** What a script for web workers takes for granted. */
const scope = `{
  const { parentPort } = require('node:worker_threads');
  globalThis.postMessage = (message) => parentPort.postMessage(message);
  globalThis.close = () => parentPort.close();
  parentPort.on('message', (data) => globalThis.onmessage({ data }));
}
`;

const startWorker: StartWorker = (script, onMessage, onError) => {
  const worker = new Worker(scope + script, { eval: true });
  worker.on('message', onMessage);
  worker.on('error', (error) => onError(String(error)));
  return { postMessage: (message) => worker.postMessage(message), terminate: () => void worker.terminate() };
};

export function activate(context: vscode.ExtensionContext): void {
  const hasModule = existsSync(context.asAbsolutePath('dist/web/isocnc.wasm'));
  const module = new ModulePrograms(context, startWorker);
  start(context, (name) => {
    const native = findNative(name, context);
    // The folder that the user names is never passed over in silence.
    return native ?? (hasModule && !settings().get('path', '') ? module.find(name) : null);
  });
}

export const deactivate = stop;

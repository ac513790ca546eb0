/** The entry in a browser: the programs are those of the WebAssembly module. */
import * as vscode from 'vscode';
import { start, stop } from './activation';
import { ModulePrograms } from './module/programs';
import type { StartWorker } from './module/worker';

/** What this takes of a browser's. */
declare class Worker {
  constructor(url: string);
  onmessage: (event: { data: unknown }) => void;
  onerror: (event: { message?: string }) => void;
  postMessage(message: unknown): void;
  terminate(): void;
}

/** A worker's script has to come from the origin of its page, which is not where extensions come from. */
const startWorker: StartWorker = (script, onMessage, onError) => {
  const url = URL.createObjectURL(new Blob([script], { type: 'text/javascript' }));
  const worker = new Worker(url);
  worker.onmessage = ({ data }) => onMessage(data);
  worker.onerror = ({ message }) => onError(message ?? 'the worker has failed');
  return {
    postMessage: (message) => worker.postMessage(message),
    terminate: () => {
      worker.terminate();
      URL.revokeObjectURL(url);
    },
  };
};

export function activate(context: vscode.ExtensionContext): void {
  const module = new ModulePrograms(context, startWorker);
  start(context, (name) => module.find(name));
}

export const deactivate = stop;

/** Commands on texts: their standard streams are files in the module's memory. */
import { run, type Files, type Module, type Program } from './module';

const [input, output, complaints] = ['/isocnc.in', '/isocnc.out', '/isocnc.err'];

/** What a command has written. */
export interface Outcome {
  status: number;
  output: string;
  complaints: string;
}

/** The content of all files by their paths, but for those of the system and of the streams. */
export function filesIn(FS: Files, folder = ''): Map<string, Uint8Array> {
  const files = new Map<string, Uint8Array>();
  for (const name of FS.readdir(folder || '/')) {
    const path = `${folder}/${name}`;
    if (name === '.' || name === '..' || /^\/(?:dev|proc|isocnc\.\w+)$/.test(path)) continue;
    if (!FS.isDir(FS.stat(path).mode)) files.set(path, FS.readFile(path));
    else for (const [inside, content] of filesIn(FS, path)) files.set(inside, content);
  }
  return files;
}

/** Makes a standard stream a file. */
function redirect(module: Module, descriptor: number, path: string, flags: string): void {
  module.FS.close(module.FS.streams[descriptor]);
  module.FS.open(path, flags); // Takes the lowest number that is free.
}

/** Runs a command with `text` at its standard input. */
export function runOnText(module: Module, program: Program, args: readonly string[], text = ''): Outcome {
  const { FS } = module;
  FS.writeFile(input, new TextEncoder().encode(text)); // Much faster than Emscripten's own.
  FS.writeFile(output, '');
  FS.writeFile(complaints, '');
  redirect(module, 0, input, 'r');
  redirect(module, 1, output, 'w');
  redirect(module, 2, complaints, 'w');
  const status = run(module, program, args);
  const utf8 = new TextDecoder('utf-8', { ignoreBOM: true });
  const [written, complained] = [output, complaints].map((path) => utf8.decode(FS.readFile(path)));
  return { status, output: written, complaints: complained };
}

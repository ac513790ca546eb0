/** Commands on texts: standard input is a file in the module's memory, and what they write becomes text. */
import { run, type Files, type Module, type OpenFile, type Program } from './module';

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
function redirect(module: Module, descriptor: number, path: string, flags: string): OpenFile {
  module.FS.close(module.FS.streams[descriptor]);
  return module.FS.open(path, flags); // Takes the lowest number that is free.
}

/** Makes a standard stream a text, which is returned by the result. Of a file in memory all would be copied again and again as it grows. */
function collect(module: Module, descriptor: number, path: string): () => string {
  const utf8 = new TextDecoder('utf-8', { ignoreBOM: true });
  let text = '';
  const stream = redirect(module, descriptor, path, 'w');
  stream.stream_ops = {
    ...stream.stream_ops,
    write(_stream, bytes, offset, length) {
      text += utf8.decode(bytes.subarray(offset, offset + length), { stream: true });
      return length;
    },
  };
  return () => text + utf8.decode();
}

/** Runs a command with `text` at its standard input. */
export function runOnText(module: Module, program: Program, args: readonly string[], text = ''): Outcome {
  const { FS } = module;
  FS.writeFile(input, new TextEncoder().encode(text), { canOwn: true }); // Much faster than Emscripten's own, and not copied.
  redirect(module, 0, input, 'r');
  const written = collect(module, 1, output);
  const complained = collect(module, 2, complaints);
  const status = run(module, program, args);
  return { status, output: written(), complaints: complained() };
}

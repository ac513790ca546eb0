/** Commands on texts: standard input is one text, and what they write becomes another. */
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
function redirect({ FS }: Module, descriptor: number, path: string, flags: string): OpenFile {
  FS.close(FS.streams[descriptor]);
  return FS.open(path, flags); // Takes the lowest number that is free.
}

/**
 * Makes standard input a text. It is encoded right into the memory of the one who reads: a file in between costs more than
 * the check of a long program.
 */
function provide(module: Module, text: string): void {
  module.FS.writeFile(input, '');
  const stream = redirect(module, 0, input, 'r');
  const utf8 = new TextEncoder();
  let position = 0;
  let rest: Uint8Array = new Uint8Array(); // Of a character that has no room where the reader ends.
  stream.stream_ops = {
    ...stream.stream_ops,
    read(_stream, bytes, offset, length) {
      const room = new Uint8Array(bytes.buffer, bytes.byteOffset + offset, length);
      if (rest.length === 0) {
        const { read, written } = utf8.encodeInto(text.slice(position), room);
        position += read;
        if (written > 0 || position === text.length) return written;
        rest = utf8.encode(String.fromCodePoint(text.codePointAt(position)!));
        position += text.codePointAt(position)! > 0xffff ? 2 : 1;
      }
      const part = rest.subarray(0, length);
      room.set(part);
      rest = rest.subarray(part.length);
      return part.length;
    },
  };
  // The reader makes room for as much as the file is long: without umlauts, all of it at once.
  const { getattr } = stream.node.node_ops;
  stream.node.node_ops = { ...stream.node.node_ops, getattr: (node) => ({ ...getattr(node), size: text.length }) };
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
  provide(module, text);
  const written = collect(module, 1, output);
  const complained = collect(module, 2, complaints);
  const status = run(module, program, args);
  return { status, output: written(), complaints: complained() };
}

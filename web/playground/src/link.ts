/** A program as the fragment of a link: UTF-8, compressed with DEFLATE, in base64url. */

const prefix = '#program=';
/** Mail and chat programs cut longer links. */
export const longestLink = 30_000;
/** What a few characters can be uncompressed to has an end. */
const largestProgram = 1 << 22;

export type LinkFailure = 'linkCut' | 'linkLetters' | 'linkLarge';

/** The fragment is none of ours, or damaged. */
export class LinkError extends Error {
  constructor(readonly failure: LinkFailure) {
    super(failure);
  }
}

const streamOf = (bytes: Uint8Array<ArrayBuffer>) => new Blob([bytes]).stream();

/** Reads a stream whole; throws where it has more than `largest` bytes. */
async function read(stream: ReadableStream<Uint8Array>, largest = Infinity): Promise<Uint8Array> {
  const parts: Uint8Array[] = [];
  let size = 0;
  const reader = stream.getReader();
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    size += part.value.length;
    if (size > largest) {
      await reader.cancel();
      throw new LinkError('linkLarge');
    }
    parts.push(part.value);
  }
  const bytes = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

/** Throws a LinkError where the program is too large to be read again. */
export async function fragmentOf(program: string): Promise<string> {
  const text = new TextEncoder().encode(program);
  if (text.length > largestProgram) throw new LinkError('linkLarge'); // As whoever opens the link would hear.
  const bytes = await read(streamOf(text).pipeThrough(new CompressionStream('deflate')));
  let binary = '';
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return prefix + btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

/** The program in a fragment; null where it holds none. Throws a LinkError where it is damaged. */
export async function programOf(fragment: string): Promise<string | null> {
  if (!fragment.startsWith(prefix)) return null;
  const encoded = fragment.slice(prefix.length);
  if (!/^[\w-]+$/.test(encoded)) throw new LinkError(encoded === '' ? 'linkCut' : 'linkLetters');
  if (encoded.length % 4 === 1) throw new LinkError('linkCut');
  const binary = atob(encoded.replaceAll('-', '+').replaceAll('_', '/'));
  try {
    const bytes = Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
    const text = await read(streamOf(bytes).pipeThrough(new DecompressionStream('deflate')), largestProgram);
    return new TextDecoder('utf-8', { fatal: true }).decode(text);
  } catch (failure) {
    // The check sum at its end, which the last characters hold, does not fit.
    throw failure instanceof LinkError ? failure : new LinkError('linkCut');
  }
}

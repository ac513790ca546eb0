/** A worker that gets the WebAssembly module, compressed with xz, and answers with what the browser has compiled of it. */
import { XzReadableStream } from 'xz-decompress';
import { throwToPage } from '../../src/uncaught';

const scope = globalThis as unknown as { onmessage: (event: { data: Uint8Array<ArrayBuffer> }) => void; postMessage(message: WebAssembly.Module): void };

/** Compiles each part as soon as it is unpacked. */
const compile = (packed: Uint8Array<ArrayBuffer>) =>
  WebAssembly.compileStreaming(
    new Response(new XzReadableStream(new Blob([packed]).stream()), { headers: { 'content-type': 'application/wasm' } }),
  );

scope.onmessage = ({ data }) => {
  compile(data).then((compiled) => scope.postMessage(compiled), throwToPage);
};

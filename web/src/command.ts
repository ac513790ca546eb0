/** The commands under Node.js: with the files, the streams and the environment of the computer. */
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { isatty } from 'node:tty';
import { fileURLToPath } from 'node:url';
import { run, type MakeModule, type Program } from './module';

export async function main(program: Program): Promise<void> {
  const makeModule = createRequire(import.meta.url)('./isocnc-node.cjs') as MakeModule;
  const module = await makeModule({
    wasmBinary: readFileSync(fileURLToPath(new URL('isocnc.wasm', import.meta.url))),
    isTerminal: isatty,
    preRun: [(starting) => void Object.assign(starting.ENV, process.env)],
  });
  process.exitCode = run(module, program, process.argv.slice(2));
}

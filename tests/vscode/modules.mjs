// Modules of the extension, made to run here.
import { mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

export const root = fileURLToPath(new URL('../../', import.meta.url));
export const extension = join(root, 'vscode-extension');
export const requireFromExtension = createRequire(join(extension, 'package.json'));

const folder = mkdtempSync(join(tmpdir(), 'isocnc-modules-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

/** A file of vscode-extension/src. */
export async function module(name) {
  const outfile = join(folder, `${name.replaceAll('/', '-')}.mjs`);
  requireFromExtension('esbuild').buildSync({ entryPoints: [join(extension, 'src', `${name}.ts`)], bundle: true, format: 'esm', platform: 'node', outfile });
  return import(pathToFileURL(outfile));
}

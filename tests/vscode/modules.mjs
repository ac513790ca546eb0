// Modules of the extension, made to run here.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

export const root = fileURLToPath(new URL('../../', import.meta.url));
export const extension = join(root, 'vscode-extension');
export const requireFromExtension = createRequire(join(extension, 'package.json'));

const folder = mkdtempSync(join(tmpdir(), 'isocnc-modules-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

/** A file of vscode-extension/src; `replacements` are sources of modules that it imports, by their names. */
export async function module(name, replacements = {}) {
  const outfile = join(folder, `${name.replaceAll('/', '-')}.mjs`);
  const alias = {};
  for (const [replaced, source] of Object.entries(replacements)) {
    alias[replaced] = join(folder, `${replaced.replaceAll('/', '-')}.replacement.mjs`);
    writeFileSync(alias[replaced], source);
  }
  requireFromExtension('esbuild').buildSync({ entryPoints: [join(extension, 'src', `${name}.ts`)], bundle: true, format: 'esm', platform: 'node', outfile, alias });
  return import(pathToFileURL(outfile));
}

// Modules of the extension and of the toolpath's view, made to run here.
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
export const module = (name, replacements = {}) => loaded(join(extension, 'src', `${name}.ts`), name, replacements);

/** A file of toolpath-view/src. */
export const viewModule = (name) => loaded(join(root, 'toolpath-view/src', `${name}.ts`), name);

async function loaded(file, name, replacements = {}) {
  const outfile = join(folder, `${name.replaceAll('/', '-')}.mjs`);
  const alias = {};
  for (const [replaced, source] of Object.entries(replacements)) {
    alias[replaced] = join(folder, `${replaced.replaceAll('/', '-')}.replacement.mjs`);
    writeFileSync(alias[replaced], source);
  }
  requireFromExtension('esbuild').buildSync({ entryPoints: [file], bundle: true, format: 'esm', platform: 'node', mainFields: ['module', 'main'], outfile, alias });
  return import(pathToFileURL(outfile));
}

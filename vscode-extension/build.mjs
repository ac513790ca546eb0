// Bundles the extension into dist/: its own scripts, for Node.js and for browsers, and the page of the toolpath with script and style.
import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = (name) => fileURLToPath(new URL(name, import.meta.url));
const common = { bundle: true, minify: true, charset: 'utf8', target: 'es2022', legalComments: 'linked', logLevel: 'warning' };

await Promise.all([
  build({
    ...common,
    entryPoints: [here('src/extension.ts')],
    outfile: here('dist/extension.js'),
    platform: 'node',
    format: 'cjs',
    external: ['vscode'],
    mainFields: ['module', 'main'],
  }),
  build({
    ...common,
    entryPoints: [here('src/browser.ts')],
    outfile: here('dist/browser.js'),
    platform: 'browser',
    format: 'cjs',
    external: ['vscode'],
    mainFields: ['browser', 'module', 'main'],
  }),
  build({
    ...common,
    entryPoints: { toolpath: here('src/webview/main.ts'), form: here('src/webview/form.ts') },
    outdir: here('dist'),
    format: 'iife',
    // What the view needs is its own.
    nodePaths: [here('../toolpath-view/node_modules')],
  }),
  build({ ...common, entryPoints: { toolpath: here('src/webview/toolpath.css'), form: here('src/webview/form.css') }, outdir: here('dist') }),
]);

// The page of isorun without what the editor has itself; the rest is filled in where it is shown.
const left = { program: '', choices: '' };
const page = readFileSync(here('../toolpath-view/src/page.html'), 'utf8')
  .replace(/\{\{(\w+)\}\}/g, (part, name) => left[name] ?? part)
  .replace('<!--title-->', 'ISOCNC')
  .replace('<!--data-->\n', '');
writeFileSync(here('dist/toolpath.html'), page);

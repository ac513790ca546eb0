// Makes the playground, one folder without a server behind it: node build.mjs [FOLDER OF THE BUILD FOR WEBASSEMBLY] [OUT]
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const root = fileURLToPath(new URL('../..', import.meta.url));
const here = join(root, 'web/playground');
const made = resolve(process.argv[2] ?? join(root, 'build/web'));
const target = resolve(process.argv[3] ?? join(made, 'playground'));

rmSync(target, { recursive: true, force: true });
mkdirSync(target, { recursive: true });

const common = { bundle: true, minify: true, charset: 'utf8', target: 'es2022', legalComments: 'linked', logLevel: 'warning', absWorkingDir: here };
await Promise.all([
  build({
    ...common,
    entryPoints: ['src/main.ts'],
    outfile: join(target, 'playground.js'),
    format: 'iife',
    loader: { '.iso': 'text', '.ttf': 'dataurl' },
    // Its styles stand in playground.css, with those of Monaco before our own.
    // What the view needs is its own.
    nodePaths: [join(root, 'toolpath-view/node_modules')],
  }),
  build({ ...common, entryPoints: ['src/playground.css'], outfile: join(target, 'own.css') }),
]);
// Ours come after Monaco's, which esbuild has gathered beside the script.
writeFileSync(join(target, 'playground.css'), Buffer.concat([readFileSync(join(target, 'playground.css')), readFileSync(join(target, 'own.css'))]));
rmSync(join(target, 'own.css'));

// A page from a disk may fetch nothing, so that the module is in a script.
const dist = join(made, 'npm/dist');
const wasm = gzipSync(readFileSync(join(dist, 'isocnc.wasm')), { level: 9 }).toString('base64');
const worker = readFileSync(join(dist, 'worker.js'), 'utf8');
writeFileSync(join(target, 'module.js'), `globalThis.isocncModule = ${JSON.stringify({ wasm, worker })};\n`);

// The parts of the view's page that this one has, too.
const view = readFileSync(join(root, 'toolpath-view/src/page.html'), 'utf8');
function part(start, end) {
  const from = view.indexOf(start);
  const to = view.indexOf(end, from);
  if (from < 0 || to < 0) throw new Error(`toolpath-view/src/page.html has no ${start}`);
  return view.slice(from, to + end.length);
}
const parts = {
  // No connection at all: that makes it true that nothing leaves the browser. The worker and its module come from module.js.
  // Monaco writes styles of its own.
  policy: [
    "default-src 'none'",
    "script-src 'self' 'wasm-unsafe-eval'",
    'worker-src blob:',
    "style-src 'self' 'unsafe-inline'",
    'font-src data:',
    'img-src data:',
    "connect-src 'none'",
    "base-uri 'none'",
    "form-action 'none'",
  ].join('; '),
  icon: readFileSync(join(root, 'vscode-extension/media/icon.svg')).toString('base64'),
  outcome: part('<p id="outcome"', '</p>'),
  totals: part('<dl id="totals"', '</dl>'),
  help: part('<button id="help"', '</button>'),
  // Sections within it are indented deeper.
  view: part('<section id="view"', '\n  </section>'),
  player: part('<footer', '</footer>'),
  keys: part('<dialog id="keys"', '</dialog>'),
};
const page = readFileSync(join(here, 'src/index.html'), 'utf8').replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
writeFileSync(join(target, 'index.html'), page);
cpSync(join(root, 'LICENSE'), join(target, 'LICENSE'));

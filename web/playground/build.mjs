// Makes the playground, one folder without a server behind it: node build.mjs [FOLDER OF THE BUILD FOR WEBASSEMBLY] [OUT]
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
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

const [unpacker] = (await build({ ...common, entryPoints: ['src/unpacker.ts'], format: 'iife', legalComments: 'inline', write: false })).outputFiles;
const contents = {
  // xz, which no browser unpacks of itself, saves 0.5 of the 1.7 MB that gzip makes of it.
  module: { contents: execFileSync('xz', ['-9e', '--threads=1', '--stdout', join(made, 'bin/playground.wasm')], { maxBuffer: 2 ** 28 }), loader: 'binary' },
  unpacker: { contents: unpacker.contents, loader: 'text' },
  worker: { contents: readFileSync(join(made, 'bin/playground-worker.js')), loader: 'text' },
};
const embedded = {
  name: 'embedded',
  setup(bundle) {
    bundle.onResolve({ filter: /^embedded:/ }, ({ path }) => ({ path: path.replace('embedded:', ''), namespace: 'embedded' }));
    bundle.onLoad({ filter: /./, namespace: 'embedded' }, ({ path }) => contents[path]);
  },
};
await build({ ...common, entryPoints: ['src/module.ts'], outfile: join(target, 'module.js'), format: 'iife', plugins: [embedded] });

// The parts of the view's page that this one has, too.
const view = readFileSync(join(root, 'toolpath-view/src/page.html'), 'utf8');
/** The element that begins with `start`, whole, with all that stands in it. */
function part(start) {
  const from = view.indexOf(start);
  if (from < 0) throw new Error(`toolpath-view/src/page.html has no ${start}`);
  const name = start.match(/^<(\w+)/)[1];
  let open = 0;
  for (const tag of view.slice(from).matchAll(new RegExp(`<(/?)${name}\\b[^>]*>`, 'g'))) {
    open += tag[1] ? -1 : 1;
    if (open === 0) return view.slice(from, from + tag.index + tag[0].length);
  }
  throw new Error(`toolpath-view/src/page.html does not close ${start}`);
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
  outcome: part('<p id="outcome"'),
  totals: part('<dl id="totals"'),
  help: part('<button id="help"'),
  view: part('<section id="view"'),
  player: part('<footer'),
  keys: part('<dialog id="keys"'),
};
const page = readFileSync(join(here, 'src/index.html'), 'utf8').replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
writeFileSync(join(target, 'index.html'), page);
cpSync(join(root, 'LICENSE'), join(target, 'LICENSE'));

// Makes the extension's package for a platform: node package.mjs [FOLDER] [--target linux-x64|linux-arm64|win32-x64|web|universal|...]
// Without --target it is the platform of this machine. It gathers in build/vscode-extension/stage what belongs to it: what is built, the
// programs (of build/release/bin, or of the folder ISOCNC_BIN_DIR), and what has its home elsewhere in the repository. The packages `web`, for
// browsers, and `universal`, for them and for platforms that have no package of their own, hold no programs, but the module of them:
// build/web/npm/dist, or the folder ISOCNC_WEB_DIR. ISOCNC_NOTICES names a file with the licenses of what is bundled.
import { execFileSync } from 'node:child_process';
import { chmodSync, cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { createVSIX } from '@vscode/vsce';
import { version } from '../cmake/version.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));
const here = join(root, 'vscode-extension');
const { values: options, positionals } = parseArgs({ allowPositionals: true, options: { target: { type: 'string' } } });
const folder = resolve(positionals[0] ?? join(root, 'build/vscode-extension'));
const platform = options.target ?? `${process.platform}-${process.arch}`;
const stage = join(folder, 'stage');
const programs = resolve(process.env.ISOCNC_BIN_DIR ?? join(root, 'build/release/bin'));
const module = resolve(process.env.ISOCNC_WEB_DIR ?? join(root, 'build/web/npm/dist'));
const isOfModule = ['web', 'universal'].includes(platform);
const ending = platform.startsWith('win32-') ? '.exe' : '';
/** The commands that strip programs for other platforms than this machine's. */
const strips = { 'win32-x64': 'x86_64-w64-mingw32-strip', 'linux-arm64': process.arch === 'arm64' ? 'strip' : 'aarch64-linux-gnu-strip' };

/** The debugger comes where it has been built. */
const needed = ['isols', 'isolint', 'isorun', 'isofmt', 'isodiff'];
const optional = ['isodap'];

function stageProgram(name) {
  const file = join(programs, name + ending);
  if (!existsSync(file) && optional.includes(name)) return;
  const copy = join(stage, 'bin', name + ending);
  cpSync(file, copy);
  if (process.platform !== 'win32') execFileSync(strips[platform] ?? 'strip', [copy]);
  chmodSync(copy, 0o755);
}

/** The programs as one module, and the worker that holds it: what a browser can start. */
function stageModule() {
  for (const name of ['isocnc.wasm', 'worker.js']) cpSync(join(module, name), join(stage, 'dist/web', name));
}

function stagePackageJson() {
  const json = JSON.parse(readFileSync(join(here, 'package.json'), 'utf8'));
  // All is bundled: what is installed needs none of these.
  for (const key of ['private', 'scripts', 'dependencies', 'devDependencies']) delete json[key];
  if (!isOfModule) delete json.browser;
  json.version = version; // package.json has a placeholder, which VS Code wants where it runs the extension from this folder.
  writeFileSync(join(stage, 'package.json'), JSON.stringify(json, null, 2));
  return json;
}

/** Pictures have their home in docs/images. */
function stageReadme() {
  const readme = readFileSync(join(here, 'README.md'), 'utf8').replaceAll(/\.\.\/docs\/images\/([\w-]+\.png)/g, (_, name) => {
    cpSync(join(root, 'docs/images', name), join(stage, 'images', name));
    return `images/${name}`;
  });
  writeFileSync(join(stage, 'README.md'), readme);
}

rmSync(stage, { recursive: true, force: true });
mkdirSync(join(stage, 'images'), { recursive: true });
for (const name of ['dist', 'l10n', 'media', 'snippets', 'syntaxes', 'test-drive', 'language-configuration.json', 'package.nls.json', 'package.nls.it.json'])
  cpSync(join(here, name), join(stage, name), { recursive: true });
rmSync(join(stage, 'media/icon.svg'));
for (const name of ['LICENSE', 'CHANGELOG.md']) cpSync(join(root, name), join(stage, name));
for (const name of ['isocnc', 'isocnc-setup']) {
  cpSync(join(root, `docs/${name}.schema.json`), join(stage, `${name}.schema.json`));
  cpSync(join(root, `docs/${name}.schema.it.json`), join(stage, `${name}.schema.it.json`));
}
for (const name of ['pocket.iso', 'five-axis.iso', 'option.iso']) cpSync(join(root, 'examples', name), join(stage, 'test-drive', name));
if (process.env.ISOCNC_NOTICES) cpSync(process.env.ISOCNC_NOTICES, join(stage, 'third-party-notices.txt'));
if (isOfModule) {
  stageModule();
} else {
  for (const name of readdirSync(join(stage, 'dist'))) if (name.startsWith('browser.')) rmSync(join(stage, 'dist', name));
  for (const name of [...needed, ...optional]) stageProgram(name);
}
stageReadme();
const { name, contributes } = stagePackageJson();
for (const { media } of contributes.walkthroughs[0].steps)
  if (media.image) cpSync(join(root, 'docs', media.image), join(stage, media.image));

const packagePath = join(folder, `${name}-${platform}-${version}.vsix`);
await createVSIX({
  cwd: stage,
  packagePath,
  target: platform === 'universal' ? undefined : platform,
  dependencies: false,
  allowMissingRepository: true,
  rewriteRelativeLinks: false,
});
console.log(packagePath);

// Makes the extension's package for this platform: node package.mjs [FOLDER]
// It gathers in build/vscode-extension/stage what belongs to it: what is built, the programs (of build/release/bin, or of
// the folder ISOCNC_BIN_DIR), and what has its home elsewhere in the repository.
import { execFileSync } from 'node:child_process';
import { chmodSync, cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { createVSIX } from '@vscode/vsce';

const root = fileURLToPath(new URL('..', import.meta.url));
const here = join(root, 'vscode-extension');
const target = resolve(process.argv[2] ?? join(root, 'build/vscode-extension'));
const stage = join(target, 'stage');
const programs = resolve(process.env.ISOCNC_BIN_DIR ?? join(root, 'build/release/bin'));
const ending = process.platform === 'win32' ? '.exe' : '';

/** The debugger comes where it has been built. */
const needed = ['isols', 'isolint', 'isorun', 'isofmt'];
const optional = ['isodap'];

function stageProgram(name) {
  const file = join(programs, name + ending);
  if (!existsSync(file) && optional.includes(name)) return;
  const copy = join(stage, 'bin', name + ending);
  cpSync(file, copy);
  if (process.platform !== 'win32') execFileSync('strip', [copy]);
  chmodSync(copy, 0o755);
}

function stagePackageJson() {
  const json = JSON.parse(readFileSync(join(here, 'package.json'), 'utf8'));
  // All is bundled: what is installed needs none of these.
  for (const key of ['private', 'scripts', 'dependencies', 'devDependencies']) delete json[key];
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
mkdirSync(join(stage, 'bin'), { recursive: true });
mkdirSync(join(stage, 'images'));
for (const name of ['dist', 'l10n', 'media', 'snippets', 'syntaxes', 'test-drive', 'language-configuration.json', 'package.nls.json', 'package.nls.it.json'])
  cpSync(join(here, name), join(stage, name), { recursive: true });
rmSync(join(stage, 'media/icon.svg'));
for (const name of ['LICENSE', 'CHANGELOG.md']) cpSync(join(root, name), join(stage, name));
cpSync(join(root, 'docs/isocnc.schema.json'), join(stage, 'isocnc.schema.json'));
for (const name of ['pocket.iso', 'five-axis.iso', 'option.iso']) cpSync(join(root, 'examples', name), join(stage, 'test-drive', name));
for (const name of [...needed, ...optional]) stageProgram(name);
stageReadme();
const { name, version, contributes } = stagePackageJson();
for (const { media } of contributes.walkthroughs[0].steps)
  if (media.image) cpSync(join(root, 'docs', media.image), join(stage, media.image));

const platform = `${process.platform}-${process.arch}`;
const packagePath = join(target, `${name}-${platform}-${version}.vsix`);
await createVSIX({
  cwd: stage,
  packagePath,
  target: platform,
  dependencies: false,
  allowMissingRepository: true,
  rewriteRelativeLinks: false,
});
console.log(packagePath);

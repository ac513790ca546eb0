// Makes the npm package of the module: node build.mjs [FOLDER OF THE BUILD]
// In its folder npm/ it gathers the loaders and the module of bin/, what is bundled of src/, and the declarations of its types.
import { execFileSync } from 'node:child_process';
import { chmodSync, cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { version } from '../cmake/version.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));
const here = join(root, 'web');
const made = resolve(process.argv[2] ?? join(root, 'build/web'));
const target = join(made, 'npm');

rmSync(target, { recursive: true, force: true });
for (const folder of ['bin', 'dist']) mkdirSync(join(target, folder), { recursive: true });
for (const name of ['isocnc.mjs', 'isocnc-node.cjs', 'isocnc.wasm']) cpSync(join(made, 'bin', name), join(target, 'dist', name));
chmodSync(join(target, 'dist/isocnc.wasm'), 0o644);

/** What imports glue.ts gets the loader of a module for pages: `inside` the bundle, or beside it. */
const glue = (inside) => ({
  name: 'glue',
  setup(bundle) {
    bundle.onResolve({ filter: /^\.\/glue$/ }, () => (inside ? { path: join(made, 'bin', inside) } : { path: './isocnc.mjs', external: true }));
  },
});
const worker = (loader, outfile) =>
  build({ ...common, entryPoints: ['src/worker.ts'], outfile, format: 'iife', minify: true, plugins: [glue(loader)], define: { 'import.meta.url': `"file:///${loader}"` }, external: ['module'] });
const common = { bundle: true, charset: 'utf8', target: 'es2022', logLevel: 'warning', absWorkingDir: here };
await Promise.all([
  build({ ...common, entryPoints: ['src/index.ts'], outfile: join(target, 'dist/index.js'), format: 'esm', external: ['node:*'], plugins: [glue()] }),
  build({ ...common, entryPoints: ['src/command.ts'], outfile: join(target, 'dist/command.js'), format: 'esm', platform: 'node' }),
  build({ ...common, entryPoints: ['src/stdio.ts'], outfile: join(made, 'emulated/stdio.mjs'), format: 'esm', platform: 'node' }),
  worker('isocnc.mjs', join(target, 'dist/worker.js')),
  worker('playground.mjs', join(made, 'bin/playground-worker.js')),
]);
execFileSync(join(here, 'node_modules/.bin/tsc'), ['--noEmit', 'false', '--emitDeclarationOnly', '--outDir', join(target, 'types')], { cwd: here, stdio: 'inherit' });
cpSync(join(target, 'types/index.d.ts'), join(target, 'dist/index.d.ts'));
rmSync(join(target, 'types'), { recursive: true });

const json = JSON.parse(readFileSync(join(here, 'package.json'), 'utf8'));
for (const program of Object.keys(json.bin)) {
  const file = join(target, 'bin', `${program}.js`);
  writeFileSync(file, `#!/usr/bin/env node\nimport { main } from '../dist/command.js';\nawait main('${program}');\n`);
  chmodSync(file, 0o755);
}
for (const key of ['scripts', 'devDependencies']) delete json[key];
writeFileSync(join(target, 'package.json'), `${JSON.stringify({ name: json.name, version, ...json }, null, 2)}\n`);
cpSync(join(root, 'LICENSE'), join(target, 'LICENSE'));
cpSync(join(here, 'README.md'), join(target, 'README.md'));

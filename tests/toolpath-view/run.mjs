// What the tests of the page share: programs run into pages, and the view's modules.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

export const root = fileURLToPath(new URL('../../', import.meta.url));
const isorun = process.env.ISORUN ?? join(root, 'build/release/bin/isorun');

/** Of what toolpath-view/package.json names. */
export const requireFromView = createRequire(join(root, 'toolpath-view/package.json'));

/** Ends the test as skipped, as CMake knows it. */
export function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}

export const folder = mkdtempSync(join(tmpdir(), 'isocnc-page-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

export function write(name, text) {
  const file = join(folder, name);
  writeFileSync(file, text);
  return file;
}

/** Runs a program; the exit status is the caller's to judge. */
export function run(...options) {
  return spawnSync(isorun, options, { encoding: 'utf8', maxBuffer: 1 << 28 });
}

/** The page of a program, as the path of its file. */
export function pageOf(program, ...options) {
  const page = join(folder, `${process.hrtime.bigint()}.html`);
  const { status, stderr } = run('--plot', page, '--no-config', ...options, program);
  if (status !== 0) throw new Error(`isorun: ${stderr}`);
  return page;
}

/** A module of the view, made to run here. */
export async function viewModule(name) {
  const { buildSync } = requireFromView('esbuild');
  const out = join(folder, `${name}.mjs`);
  buildSync({ entryPoints: [join(root, 'toolpath-view/src', `${name}.ts`)], bundle: true, format: 'esm', outfile: out });
  return import(pathToFileURL(out));
}

/** The data of a page, as its script finds it. */
export function recordingIn(page) {
  const html = readFileSync(page, 'utf8');
  const block = (id) => new RegExp(`<script id="data-${id}"[^>]*>([^<]*)</script>`).exec(html)[1];
  const bytes = (id) => new Uint8Array(Buffer.from(block(id), 'base64'));
  return { facts: JSON.parse(block('facts')), steps: bytes('steps'), points: bytes('points'), turns: bytes('turns') };
}


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
  const cuts = html.includes('id="data-cuts"') && { cuts: bytes('cuts') };
  return { facts: JSON.parse(block('facts')), steps: bytes('steps'), points: bytes('points'), turns: bytes('turns'), ...cuts };
}


/** A number of seven bits a byte, the lowest first; signed ones take the lowest bit for their sign. */
export function packed(value) {
  const bytes = [];
  for (; value >= 0x80; value = Math.floor(value / 0x80)) bytes.push((value % 0x80) + 0x80);
  return [...bytes, value];
}
export const packedSigned = (value) => packed(value < 0 ? -2 * value - 1 : 2 * value);

/** A recording written by hand. Moves have `line` (from 1), `kind` (0 rapid, 1 feed move, 2 arc), `tool` (place among the facts' tools), and `points`, each
 * [x, y, z, b, c] in mm and degrees, with the seconds that each takes; the tool moves evenly. */
export function recordingOf(facts, moves) {
  const [steps, points, turns] = [[], [], []];
  let [line, sinceTurn] = [0, 0];
  let last = facts.home;
  for (const move of moves) {
    steps.push(...packed(move.kind | 0x04 | 0x08 | 0x40), ...packed(move.line - 1 - line), ...packed(move.tool), ...packed(move.points.length));
    line = move.line - 1;
    for (const point of move.points) {
      const place = point.map((value, i) => Math.round(value * (i < 3 ? 1e3 : 1e4)));
      for (let i = 0; i < 3; ++i) points.push(...packedSigned(place[i] - last[i]));
      points.push(...packed(Math.round(move.seconds * 1e8)), ...packedSigned(0));
      ++sinceTurn;
      if (place[3] !== last[3] || place[4] !== last[4]) {
        turns.push(...packed(sinceTurn), ...packedSigned(place[3] - last[3]), ...packedSigned(place[4] - last[4]));
        sinceTurn = 0;
      }
      last = place;
    }
  }
  const bytes = (values) => Uint8Array.from(values);
  return { facts, steps: bytes(steps), points: bytes(points), turns: bytes(turns) };
}

/** A page of this tree's own script, with a recording and a program in it. */
export async function freshPage(name, recording, program) {
  const { makePage } = await import(pathToFileURL(join(root, 'toolpath-view/page_file.mjs')));
  const base64 = (bytes) => Buffer.from(bytes).toString('base64');
  const data = { facts: JSON.stringify(recording.facts).replaceAll('<', '\\u003c'), program: base64(Buffer.from(program)) };
  for (const stream of ['steps', 'points', 'turns', 'cuts']) if (recording[stream]) data[stream] = base64(recording[stream]);
  const blocks = Object.entries(data).map(([id, text]) => `<script id="data-${id}" type="application/json">${text}</script>\n`);
  // Functions, since a replacement that is text may hold $&.
  const page = (await makePage()).replace('<!--title-->', () => name).replace('<!--data-->', () => blocks.join(''));
  return write(`${name}.html`, page);
}

/** A page of isorun with another recording in it. */
export function pageWith(recording, program) {
  const page = pageOf(write('other.iso', program));
  const base64 = (bytes) => Buffer.from(bytes).toString('base64');
  const data = { facts: JSON.stringify(recording.facts).replaceAll('<', '\\u003c') };
  for (const name of ['steps', 'points', 'turns']) data[name] = base64(recording[name]);
  let html = readFileSync(page, 'utf8');
  for (const [name, text] of Object.entries(data))
    html = html.replace(new RegExp(`(<script id="data-${name}"[^>]*>)[^<]*`), (_, start) => start + text);
  writeFileSync(page, html);
  return page;
}

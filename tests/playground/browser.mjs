// Chromium with pages of the playground, from a disk and from a server that has nothing but files.
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { extname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { deflateSync } from 'node:zlib';
import { launchOptions } from '../chromium.mjs';

export const root = fileURLToPath(new URL('../../', import.meta.url));
const { chromium } = createRequire(join(root, 'toolpath-view/package.json'))('playwright-core');
export const web = join(root, 'build/web');
const native = process.env.ISOCNC_BIN_DIR ?? join(root, 'build/release/bin');
/** Long enough for a busy machine. */
export const patience = Number(process.env.PATIENCE ?? 120_000);

/** What a program for this machine prints, in the folder of the repository. */
export function printed(program, args, input) {
  const { stdout, error } = spawnSync(join(native, program), args, { cwd: root, input, encoding: 'utf8', maxBuffer: 1 << 28 });
  if (error) throw error;
  return stdout;
}

/** The findings of isolint in a program. */
export const findingsOf = (text, language = 'en') =>
  JSON.parse(printed('isolint', ['--no-config', '--format', 'json', '--lang', language, '-'], text));

export const launch = () => chromium.launch({ ...launchOptions, timeout: patience });

const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };

/** A server of the folder build/web, which remembers the paths that it has been asked for. */
export async function serve() {
  const asked = [];
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    asked.push(pathname);
    const file = join(web, decodeURIComponent(pathname));
    if (!existsSync(file) || extname(file) === '') {
      response.writeHead(pathname === '/' ? 200 : 404, { 'content-type': 'text/html' }).end('<!doctype html>');
      return;
    }
    response.writeHead(200, { 'content-type': types[extname(file)] ?? 'text/plain' }).end(readFileSync(file));
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  return { asked, address: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

export const onDisk = pathToFileURL(join(web, 'playground/index.html')).href;

/** The fragment of a link, made without the code of the page. */
export const fragment = (text) => `#program=${deflateSync(text).toString('base64url')}`;

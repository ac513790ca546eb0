// The page of the toolpath's panel in a browser, with an editor that is played, and paths to show in it.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium, launchOptions } from '../chromium.mjs';
import { extension, requireFromExtension, root } from './modules.mjs';

const isorun = join(process.env.ISOCNC_BIN_DIR ?? join(root, 'build/release/bin'), 'isorun');
/** Long enough for a busy machine. */
const patience = 120_000;
const folder = mkdtempSync(join(tmpdir(), 'isocnc-toolpath-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

/** Why there is no browser; else false. */
export const without = existsSync(chromium) ? false : `there is no ${chromium}`;

/** What isorun records of a program: the same as isols. */
export function recordingOf(text) {
  const [program, plot] = [join(folder, 'part.iso'), join(folder, 'part.html')];
  writeFileSync(program, text);
  const { status, stderr } = spawnSync(isorun, ['--no-config', '--lang', 'en', '--plot', plot, program], { encoding: 'utf8', maxBuffer: 1 << 28 });
  assert.equal(status, 0, stderr);
  const html = readFileSync(plot, 'utf8');
  const block = (id) => new RegExp(`<script id="data-${id}"[^>]*>([^<]*)</script>`).exec(html)[1];
  return { facts: JSON.parse(block('facts')), steps: block('steps'), points: block('points'), turns: block('turns') };
}

/** The page with a script in place of VS Code's, and colors in place of its own. */
function pageFile() {
  const style = `<link rel="stylesheet" href="${pathToFileURL(join(extension, 'dist/toolpath.css'))}"><style>
    html, body { height: 100% }
    html { --vscode-editor-background: #1f1f1f; --vscode-foreground: #cccccc; --vscode-descriptionForeground: #9d9d9d;
      --vscode-editorWidget-background: #202020; --vscode-panel-border: #2b2b2b; --vscode-focusBorder: #0078d4; --vscode-font-size: 13px;
      --vscode-font-family: sans-serif; --vscode-editor-font-family: monospace; --vscode-button-background: #0078d4; --vscode-button-foreground: white;
      --vscode-textLink-foreground: #4daafc }
    html:has(.vscode-light) { --vscode-editor-background: #ffffff; --vscode-foreground: #3b3b3b; --vscode-editorWidget-background: #f8f8f8;
      --vscode-descriptionForeground: #616161; --vscode-panel-border: #e5e5e5; --vscode-textLink-foreground: #005fb8 }
    html:has(.vscode-high-contrast-light) { --vscode-editor-background: #ffffff; --vscode-foreground: #292929; --vscode-editorWidget-background: #ffffff; --vscode-contrastBorder: #0f4a85 }
    html:has(.vscode-high-contrast:not(.vscode-high-contrast-light)) { --vscode-editor-background: #000000; --vscode-foreground: #ffffff; --vscode-editorWidget-background: #000000; --vscode-contrastBorder: #6fc3df }
  </style>`;
  const script = `<script>globalThis.said = []; globalThis.acquireVsCodeApi = () => ({ postMessage: (message) => said.push(message) })</script>
    <script src="${pathToFileURL(join(extension, 'dist/toolpath.js'))}"></script>`;
  const parts = { policy: "default-src file: 'unsafe-inline'", style, script };
  const html = readFileSync(join(extension, 'dist/toolpath.html'), 'utf8').replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
  const file = join(folder, 'page.html');
  writeFileSync(file, html);
  return file;
}

/** A message to the page as the panel sends it; data in base64. */
export const wholePath = (resultId, { facts, steps, points, turns, cuts }, language = 'en') => ({
  type: 'path',
  resultId,
  previousResultId: null,
  facts,
  language,
  patches: { steps: { data: steps }, points: { data: points }, turns: { data: turns }, ...(cuts && { cuts: { data: cuts } }) },
});

/** The page, and a browser to be closed. */
export async function openPage() {
  const browser = await requireFromExtension('playwright-core').chromium.launch({ ...launchOptions, timeout: patience });
  try {
    const page = await browser.newPage({ viewport: { width: 700, height: 800 } });
    page.setDefaultTimeout(patience);
    const problems = [];
    page.on('console', (message) => {
      if (message.type() === 'error') problems.push(message.text());
    });
    page.on('pageerror', (error) => problems.push(String(error)));
    await page.goto(pathToFileURL(pageFile()).href);
    await page.evaluate(() => document.body.classList.add('vscode-dark'));
    return { browser, page, problems };
  } catch (error) {
    // Else it would keep the test from ending.
    await browser.close();
    throw error;
  }
}

/** Tells the page something; the time in ms that it has taken. */
export const postMessage = (page, message) =>
  page.evaluate((sent) => {
    const bytes = (text) => Uint8Array.from(atob(text), (each) => each.charCodeAt(0));
    for (const patch of Object.values(sent.patches ?? {})) patch.data = bytes(patch.data);
    const start = performance.now();
    window.dispatchEvent(new MessageEvent('message', { data: sent }));
    return performance.now() - start;
  }, message);

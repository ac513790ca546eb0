// A whole VS Code in a browser: code-server with a fresh profile, the packaged extension in it, Chromium in front.
import { spawn, spawnSync } from 'node:child_process';
import { once } from 'node:events';
import { cpSync, mkdirSync, mkdtempSync, openSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { setTimeout as sleep } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { launchOptions } from '../chromium.mjs';

export const root = fileURLToPath(new URL('../../', import.meta.url));
const { chromium } = createRequire(join(root, 'vscode-extension/package.json'))('playwright-core');

/** Long enough for a busy machine; nothing waits for it that has come about. */
export const patience = 60_000;

async function freePort() {
  const server = createServer().listen(0, '127.0.0.1');
  await once(server, 'listening');
  const { port } = server.address();
  server.close();
  return port;
}

/** Asks until the answer is right; reports the last answer or error if it never is. */
export async function eventually(ask, what, isRight = Boolean) {
  const end = Date.now() + patience;
  for (let last; ; await sleep(60)) {
    try {
      last = await ask();
      if (isRight(last)) return last;
    } catch (error) {
      last = error;
    }
    if (Date.now() > end) throw new Error(`${what}; at last: ${last instanceof Error ? last.message : JSON.stringify(last)}`);
  }
}

/** What all editors of the tests are set to. */
export const userSettings = {
  'workbench.startupEditor': 'none',
  'telemetry.telemetryLevel': 'off',
  'workbench.colorTheme': 'Default Dark Modern',
  'editor.minimap.enabled': false,
  'workbench.tips.enabled': false,
  'files.autoSave': 'off',
  // What moves is drawn again and again, by the processor.
  'workbench.reduceMotion': 'on',
  'editor.cursorBlinking': 'solid',
  'terminal.integrated.gpuAcceleration': 'off',
  'workbench.secondarySideBar.defaultVisibility': 'hidden',
};

export class Editor {
  #server;
  #browser;

  /** `extension` is a package; `settings` are the user's. */
  static async start({ codeServer, extension, settings = {} }) {
    const editor = new Editor();
    editor.folder = mkdtempSync(join(tmpdir(), 'isocnc-vscode-'));
    editor.workspace = join(editor.folder, 'parts');
    const at = (name) => join(editor.folder, name);
    for (const name of ['data/User', 'extensions', 'parts', 'home']) mkdirSync(at(name), { recursive: true });
    writeFileSync(
      at('data/User/settings.json'),
      JSON.stringify({ ...userSettings, ...settings }),
    );
    writeFileSync(at('config.yaml'), '');
    const entry = join(codeServer, 'node_modules/code-server/out/node/entry.js');
    const folders = ['--user-data-dir', at('data'), '--extensions-dir', at('extensions'), '--config', at('config.yaml')];
    const environment = { ...process.env, HOME: at('home'), LANG: 'C.UTF-8', LC_ALL: 'C.UTF-8' };
    for (const name of ['CONFIG', 'DATA', 'CACHE', 'STATE']) environment[`XDG_${name}_HOME`] = at(`home/${name.toLowerCase()}`);
    // Not those of an editor that the tests may be started in.
    for (const name of Object.keys(environment)) if (name.startsWith('VSCODE_')) delete environment[name];
    const installed = spawnSync(process.execPath, [entry, ...folders, '--install-extension', extension], { env: environment, encoding: 'utf8' });
    if (installed.status !== 0) throw new Error(`the extension cannot be installed: ${installed.stderr}${installed.stdout}`);
    const port = await freePort();
    const log = openSync(at('server.log'), 'w');
    editor.#server = spawn(
      process.execPath,
      [entry, ...folders, '--auth', 'none', '--bind-addr', `127.0.0.1:${port}`, '--disable-telemetry', '--disable-update-check',
        '--disable-workspace-trust', '--disable-getting-started-override', editor.workspace],
      { env: environment, detached: true, stdio: ['ignore', log, log] },
    );
    // Nothing stays behind, however the test ends.
    process.once('exit', () => editor.#kill('SIGKILL'));
    for (const signal of ['SIGINT', 'SIGTERM']) process.once(signal, () => process.exit(1));
    editor.url = `http://127.0.0.1:${port}`;
    try {
      await eventually(async () => (await fetch(`${editor.url}/healthz`)).ok, 'code-server does not answer');
      await editor.browse();
    } catch (error) {
      await editor.stop();
      throw error;
    }
    return editor;
  }

  /** Opens a page in the browser. */
  async browse() {
    this.#browser = await chromium.launch({ ...launchOptions, timeout: patience });
    const context = await this.#browser.newContext({ viewport: { width: 1440, height: 900 } });
    context.setDefaultTimeout(patience);
    this.page = await context.newPage();
  }

  async closeBrowser() {
    await this.#browser?.close().catch(() => {});
  }

  /** Puts a file into the workspace. */
  add(name, source) {
    if (typeof source === 'string' && source.includes('\n')) writeFileSync(join(this.workspace, name), source);
    else cpSync(source, join(this.workspace, name));
  }

  async openWorkbench() {
    await this.page.goto(`${this.url}/?folder=${encodeURIComponent(this.workspace)}`);
    await this.page.waitForSelector('.monaco-workbench .part.statusbar');
  }

  async press(...keys) {
    for (const key of keys) await this.page.keyboard.press(key);
  }

  /** Opens a file of the workspace by its name, on the left, where programs are. */
  async open(name) {
    await eventually(
      async () => {
        await this.press('Escape', 'Control+1', 'Control+p');
        await this.page.waitForSelector('.quick-input-widget:not([style*="display: none"]) input', { timeout: patience / 4 });
        await this.page.locator('.quick-input-widget input').first().fill(name);
        await this.page.locator('.quick-input-list .monaco-list-row.focused', { hasText: name }).waitFor({ timeout: patience / 4 });
        await this.press('Enter');
        await this.page.locator(`.tab.active[data-resource-name="${name}"]`).first().waitFor({ timeout: patience / 4 });
        return true;
      },
      `${name} does not open`,
    );
    await this.page.locator('.editor-group-container.active .monaco-editor .view-line').first().waitFor();
  }

  /** Runs a command by its title in the palette. */
  async command(title) {
    await eventually(
      async () => {
        await this.press('Escape', 'F1');
        const input = this.page.locator('.quick-input-widget input').first();
        await input.waitFor({ timeout: patience / 4 });
        await input.fill(`>${title}`);
        await this.page.locator('.quick-input-list .monaco-list-row.focused', { hasText: title }).waitFor({ timeout: patience / 4 });
        await this.press('Enter');
        return true;
      },
      `there is no command ${title}`,
    );
  }

  /** Chooses an entry in the menu of files in the Explorer. A menu that has just opened ignores clicks. */
  async chooseInExplorer(names, entry) {
    await this.command('File: Focus on Files Explorer');
    const row = (name) => this.page.locator('.explorer-folders-view .monaco-list-row', { hasText: name }).first();
    await row(names[0]).click();
    for (const name of names.slice(1)) await row(name).click({ modifiers: ['Control'] });
    await row(names.at(-1)).click({ button: 'right' });
    const menu = this.page.locator('.monaco-menu').first();
    await menu.waitFor();
    const choose = async () => {
      if (await menu.isHidden()) return true;
      await menu.locator('.action-item', { hasText: entry }).first().click({ timeout: 1000 });
      return false;
    };
    await eventually(choose, `${entry} cannot be chosen`, (isChosen) => isChosen === true);
  }

  /** The program's editor, not one of the toolpath, the console or the like. */
  get code() {
    return this.page.locator('.editor-instance .monaco-editor').first();
  }

  async focus() {
    await this.press('Control+1');
  }

  /** Puts the cursor of the program's editor there, at the end of a shorter line. Keys may be lost while the focus leaves a panel. */
  async goTo(line, column = 1) {
    await eventually(
      async () => {
        await this.press('Escape', 'Control+1', 'Control+g');
        await this.page.locator('.quick-input-widget input').first().fill(`:${line}:${column}`, { timeout: patience / 4 });
        await this.press('Enter');
        return this.place();
      },
      `the cursor is not on ${line}`,
      (place) => place.line === line && (place.column === 1) === (column === 1),
    );
  }

  /** Where the cursor is, as the status bar has it. */
  async place() {
    const text = await this.page.locator('#status\\.editor\\.selection').innerText({ timeout: patience / 4 });
    const [, line, column] = /Ln (\d+), Col (\d+)/.exec(text) ?? [];
    return { line: Number(line), column: Number(column) };
  }

  /** The line of the program's cursor, whether its editor has the focus or not. */
  async currentLine() {
    return Number(await this.code.locator('.line-numbers.active-line-number').first().innerText());
  }

  /** A visible line, its odd blanks made plain. */
  async lineText(line) {
    const text = await this.page.evaluate((number) => {
      for (const editor of document.querySelectorAll('.editor-instance .monaco-editor')) {
        const numbers = [...editor.querySelectorAll('.line-numbers')];
        const margin = numbers.find((each) => each.textContent.trim() === String(number));
        if (!margin) continue;
        const top = margin.parentElement.getBoundingClientRect().top;
        const view = [...editor.querySelectorAll('.view-line')].find((each) => Math.abs(each.getBoundingClientRect().top - top) < 3);
        if (view) return view.textContent;
      }
      return null;
    }, line);
    return text?.replace(/[\u00a0\u00b7]/g, ' ') ?? null;
  }

  /** The rows of the problems' list, which has to be open. */
  problems() {
    return this.texts('.markers-panel .monaco-list-row');
  }

  squiggles() {
    return this.page.locator('.squiggly-error').count();
  }

  /** More room for the editors. */
  async hidePanel() {
    const close = this.page.locator('.part.panel .codicon-panel-close').first();
    if (!(await close.isVisible())) return;
    await close.click();
    await close.waitFor({ state: 'hidden' });
  }

  /** F5 until the debugger is there: a busy page may lose a key. */
  startDebugging() {
    return eventually(
      async () => {
        await this.focus();
        await this.press('F5');
        await this.page.locator('.debug-toolbar').waitFor({ timeout: 15_000 });
        return true;
      },
      'F5 starts no debugger',
    );
  }

  /** VS Code unfolds the first scope at every stop, and has but those rows on the page that there is room for: it is folded again. */
  async variables() {
    const first = this.page.locator('.debug-variables .monaco-list-row[data-index="0"]').first();
    if ((await first.getAttribute('aria-expanded', { timeout: 2000 })) === 'true') await first.locator('.monaco-tl-twistie').click({ timeout: 2000 });
    return this.texts('.debug-variables .monaco-list-row');
  }

  async unfold(scope) {
    await eventually(() => this.variables(), `there is no ${scope}`, (rows) => rows.includes(scope));
    const row = this.page.locator('.debug-variables .monaco-list-row[aria-level="1"]', { hasText: scope }).first();
    if ((await row.getAttribute('aria-expanded')) !== 'true') await row.locator('.monaco-tl-twistie').click();
  }

  /** The line at which the debugger has stopped. */
  async stoppedAt() {
    return Number(/(\d+):\d+/.exec((await this.texts('.debug-call-stack .stack-frame.focused, .debug-call-stack .stack-frame')).join(' '))?.[1] ?? NaN);
  }

  async step(key, line) {
    await this.press(key);
    await eventually(() => this.stoppedAt(), `${key} does not lead to line ${line}`, (now) => now === line);
  }

  /** The line whose move is lit up in the toolpath. */
  async litLine() {
    const frame = await this.toolpath();
    return frame.evaluate(() => {
      const { path, player } = globalThis.isocnc;
      return path.stepLine[player.step] + 1;
    });
  }

  /** The frame of the toolpath's page. */
  async toolpath() {
    return eventually(async () => {
      for (const frame of this.page.frames())
        if (await frame.evaluate(() => Boolean(document.documentElement.dataset.ready && globalThis.isocnc)).catch(() => false)) return frame;
      return null;
    }, 'the toolpath does not show');
  }

  async texts(selector) {
    const texts = await this.page.locator(selector).allInnerTexts();
    return texts.map((text) => text.replace(/[\s\u00a0]+/g, ' ').trim());
  }

  /** What code-server and the extension have said, for a test that fails. */
  get log() {
    return readFileSync(join(this.folder, 'server.log'), 'utf8');
  }

  /** After a test that failed: what is on the screen, and the log, as build/vscode-extension/NAME.png and .log. */
  async showFailure(context, name = 'failed') {
    if (!context.error && context.passed !== false) return;
    const folder = join(root, 'build/vscode-extension');
    mkdirSync(folder, { recursive: true });
    await this.page.screenshot({ path: join(folder, `${name}.png`) }).catch(() => {});
    writeFileSync(join(folder, `${name}.log`), this.log);
  }

  /** A picture of what is there, once it is drawn, where ISOCNC_SCREENSHOTS names a folder for them. */
  async keepPicture(name) {
    const pictures = process.env.ISOCNC_SCREENSHOTS;
    if (!pictures) return;
    mkdirSync(pictures, { recursive: true });
    await this.page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    await this.page.screenshot({ path: join(pictures, `vscode-${name}.png`) });
  }

  /** The server's own group: the extension host and isols are in it. */
  #kill(signal) {
    try {
      process.kill(-this.#server.pid, signal);
    } catch {
      // It has ended.
    }
  }

  async stop() {
    await this.closeBrowser();
    const gone = this.#server.exitCode !== null || this.#server.signalCode !== null ? null : once(this.#server, 'exit');
    this.#kill('SIGTERM');
    await Promise.race([gone, sleep(10_000, null, { ref: false })]);
    this.#kill('SIGKILL');
    rmSync(this.folder, { recursive: true, force: true, maxRetries: 5 });
  }
}

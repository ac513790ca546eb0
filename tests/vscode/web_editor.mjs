// A VS Code that is only a page, as vscode.dev is: the workbench of code-server as files of a plain server, which starts no program.
// The extension runs in the page's web worker, and the programs are in a file system of the page's own.
import { readFileSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { once } from 'node:events';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Editor, eventually, userSettings } from './editor.mjs';

const types = {
  '.css': 'text/css', '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json', '.svg': 'image/svg+xml', '.png': 'image/png',
  '.ttf': 'font/ttf', '.wasm': 'application/wasm',
};
const escaped = (value) => JSON.stringify(value).replaceAll('&', '&amp;').replaceAll('"', '&quot;');
const scheme = 'workshop';
const folder = '/shared/parts';

export class WebEditor extends Editor {
  #server;
  /** The paths that the page has asked for. */
  requests = [];
  messages = [];

  /** `extension` is a package's content; `files` are texts by their names. */
  static async start({ codeServer, extension, files }) {
    const editor = new WebEditor();
    const vscode = join(codeServer, 'node_modules/code-server/lib/vscode');
    const respond = async (path) => {
      if (path === '/') return editor.#page(vscode);
      if (path === '/files/package.json') return readFile(fileURLToPath(new URL('web_files/package.json', import.meta.url)));
      if (path === '/files/main.js') {
        const source = readFileSync(fileURLToPath(new URL('web_files/main.js', import.meta.url)), 'utf8');
        return source.replace('= {}; // filled in', () => `= ${JSON.stringify({ [folder]: files })};`);
      }
      if (path.startsWith('/extension/')) return readFile(join(extension, path.slice('/extension'.length)));
      const content = await readFile(join(vscode, path));
      // code-server's page always takes its own server for a remote computer.
      return path.endsWith('/workbench/workbench.js') ? editor.#withoutRemote(content.toString()) : content;
    };
    editor.#server = createServer((request, response) => {
      const path = normalize(decodeURIComponent(new URL(request.url, 'http://localhost').pathname));
      editor.requests.push(path);
      respond(path).then(
        (content) => response.writeHead(200, { 'Content-Type': types[extname(path)] ?? 'text/html', 'Cache-Control': 'no-store' }).end(content),
        () => response.writeHead(404).end(),
      );
    }).listen(0, '127.0.0.1');
    await once(editor.#server, 'listening');
    editor.url = `http://127.0.0.1:${editor.#server.address().port}`;
    await editor.browse();
    editor.page.on('console', (message) => editor.messages.push(message.text()));
    editor.page.on('pageerror', (error) => editor.messages.push(String(error)));
    return editor;
  }

  #withoutRemote(script) {
    const changes = [
      [/,remoteAuthority:location\.host\}/, '}'],
      // Its settings are files of that server, those of VS Code in the page's storage.
      [/(get userRoamingDataHome\(\)\{return [\w$]+\([\w$]+\.file\(this\.userDataPath\)\.with\(\{scheme:)[\w$]+\.vscodeRemote/, '$1"vscode-userdata"'],
    ];
    for (const [old, made] of changes) {
      if (!old.test(script)) throw new Error('this workbench is another one than the test knows');
      script = script.replace(old, made);
    }
    return script;
  }

  #page(vscode) {
    const { host } = new URL(this.url);
    const at = (path) => ({ scheme: 'http', authority: host, path });
    const configuration = {
      folderUri: { scheme, authority: '', path: folder },
      additionalBuiltinExtensions: [at('/extension'), at('/files')],
      webviewEndpoint: `${this.url}/out/vs/workbench/contrib/webview/browser/pre`,
      configurationDefaults: userSettings,
      enableWorkspaceTrust: false,
      userDataPath: '/',
      isEnabledFileDownloads: true,
      isEnabledFileUploads: true,
      isEnabledCoderGettingStarted: false,
      productConfiguration: { enableTelemetry: false, extensionsGallery: undefined },
    };
    const values = { WORKBENCH_WEB_CONFIGURATION: escaped(configuration), WORKBENCH_AUTH_SESSION: '', WORKBENCH_WEB_BASE_URL: '', BASE: '', VS_BASE: '',
      WORKBENCH_NLS_FALLBACK_URL: '/out/nls.messages.js', WORKBENCH_NLS_URL: '/out/nls.messages.js' };
    return readFileSync(join(vscode, 'out/vs/code/browser/workbench/workbench.html'), 'utf8').replace(/\{\{(\w+)\}\}/g, (_, name) => values[name]);
  }

  async openWorkbench() {
    await this.page.goto(this.url);
    await this.page.waitForSelector('.monaco-workbench .part.statusbar');
  }

  /** Opens a file in the view of the folder: files of a page's own file systems cannot be searched. */
  async open(name) {
    await eventually(
      async () => {
        await this.press('Escape', 'Control+1', 'Control+Shift+e');
        await this.page.locator('.explorer-folders-view .monaco-list-row', { hasText: name }).first().dblclick({ timeout: 5000 });
        await this.page.locator(`.tab.active[data-resource-name="${name}"]`).first().waitFor({ timeout: 5000 });
        return true;
      },
      `${name} does not open`,
    );
    await this.page.locator('.editor-group-container.active .monaco-editor .view-line').first().waitFor();
  }

  get log() {
    return this.messages.join('\n');
  }

  async stop() {
    await this.closeBrowser();
    this.#server.closeAllConnections();
    this.#server.close();
  }
}

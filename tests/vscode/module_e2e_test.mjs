// The package for all platforms in code-server, where no native program is: in its Node.js, as on a desktop that has no package
// of its own, and in the page.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { Editor, eventually, root } from './editor.mjs';

const { ISOCNC_UNIVERSAL_VSIX: extension, ISOCNC_CODE_SERVER: codeServer } = process.env;
assert.ok(extension && codeServer, 'ISOCNC_UNIVERSAL_VSIX and ISOCNC_CODE_SERVER name the package and the editor: start tests/vscode/run --web');

const programs = ['isols', 'isodap', 'isolint', 'isorun', 'isofmt'];

/** The native programs that run on this computer below the test. */
function running() {
  const processes = new Map();
  for (const id of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
    try {
      const [, name, parent] = /\((.*)\) \S (\d+)/.exec(readFileSync(`/proc/${id}/stat`, 'utf8'));
      processes.set(Number(id), { name, parent: Number(parent) });
    } catch {
      // It has ended.
    }
  }
  const isOurs = (id) => id === process.pid || (processes.has(id) && isOurs(processes.get(id).parent));
  return [...processes].filter(([id, { name }]) => programs.includes(name) && isOurs(id)).map(([, { name }]) => name);
}

for (const [host, kind] of [['Node.js', 'workspace'], ['the page', 'web']])
  test(`the module checks, debugs and runs programs in ${host}`, async (context) => {
    const editor = await Editor.start({ codeServer, extension, settings: { 'remote.extensionKind': { 'isocnc.isocnc': [kind] } } });
    context.after(() => editor.stop());
    for (const name of ['start-here.iso', 'isocnc.json']) editor.add(name, join(root, 'vscode-extension/test-drive', name));
    editor.add('pocket.iso', join(root, 'examples/pocket.iso'));
    const loaded = [];
    editor.page.context().on('request', (request) => loaded.push(request.url()));
    await editor.openWorkbench();
    await editor.open('start-here.iso');
    await eventually(() => editor.squiggles(), 'nothing is underlined', (count) => count >= 3);
    await editor.open('pocket.iso');
    await editor.startDebugging();
    await eventually(() => editor.stoppedAt(), 'it does not stop at the first block', (line) => line > 0);
    const line = await editor.stoppedAt();
    await editor.step('F10', line + 1);
    await editor.page.locator('.debug-toolbar .codicon-debug-step-back').click();
    await eventually(() => editor.stoppedAt(), 'it does not step back', (now) => now === line);
    assert.deepEqual(running(), []);
    await editor.press('Shift+F5');
    await editor.page.locator('.debug-toolbar').waitFor({ state: 'hidden' });
    await editor.focus();
    await editor.press('Control+Alt+r');
    await eventually(() => editor.texts('.terminal-wrapper.active .xterm-rows'), 'nothing has been run', (rows) => /cycle time: 46\.1 s/.test(rows.join()));
    await editor.command('ISOCNC: Show Toolpath');
    const frame = await editor.toolpath();
    assert.ok((await frame.evaluate(() => globalThis.isocnc.path.stepCount)) > 50);
    // Only in the page does the page load the extension.
    assert.equal(loaded.some((url) => url.includes('dist/browser.js') || url.includes('dist%2Fbrowser.js')), kind === 'web');
  });

// The package for browsers in a VS Code that is only a page, as vscode.dev is: all of it works without a native program.
// With ISOCNC_SCREENSHOTS=FOLDER it leaves a picture there, which docs/images/ has.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, afterEach, test } from 'node:test';
import { eventually, root } from './editor.mjs';
import { WebEditor } from './web_editor.mjs';

const { ISOCNC_WEB_STAGE: extension, ISOCNC_CODE_SERVER: codeServer } = process.env;
assert.ok(extension && codeServer, 'ISOCNC_WEB_STAGE and ISOCNC_CODE_SERVER name the package\'s content and the editor: start tests/vscode/run --web');

const text = (...names) => readFileSync(join(root, ...names), 'utf8');
const registers = `; registers
M06 T101001
S12000 M03
V1 = 2.5
G00 X0 Y0 Z20
G01 Z-2 F1000
V1 = 7
X50 F3000
IF V1 > 5 GOTO N100
X80
N100 Y40
G00 Z20
M05
M02
`;
const editor = await WebEditor.start({
  codeServer,
  extension,
  files: {
    'broken.iso': text('examples/broken/pocket.iso'),
    'pocket.iso': text('examples/pocket.iso'),
    'registers.iso': registers,
    // Beyond the machine of isocnc.json.
    'travel.iso': 'G71 G90\nM06 T101001\nG00 X4000\nM02\n',
    // Never opened: what is reported of it comes from a task.
    'closed.iso': 'G71 G90\nG05 X1\nM02\n',
    '.vscode/tasks.json': JSON.stringify({ version: '2.0.0', tasks: [{ label: 'check parts', type: 'isocnc', command: 'isolint' }] }),
    'isocnc.json': text('vscode-extension/test-drive/isocnc.json'),
  },
});
const { page } = editor;
await editor.openWorkbench();

after(() => editor.stop());
afterEach((context) => editor.showFailure(context, 'failed-web'));

const lineBecomes = (line, pattern, what) => eventually(() => editor.lineText(line), what, (now) => pattern.test(now ?? ''));
const problems = () => editor.problems();
const isListed = (code) => (rows) => rows.some((row) => row.includes(code));

test('what would stop the control is underlined and listed among the problems', async () => {
  await editor.open('broken.iso');
  await eventually(() => editor.squiggles(), 'nothing is underlined', (count) => count >= 2);
  await editor.command('Problems: Focus on Problems View');
  await eventually(problems, 'the problems are not listed', isListed('ISO031'));
  for (const code of ['ISO035', 'E001', 'ISO054']) assert.ok(isListed(code)(await problems()), code);
});

test('a hover shows what a word means, and what is wrong', async () => {
  await editor.goTo(4, 9);
  await editor.press('Control+k', 'Control+i');
  await eventually(
    async () => (await editor.texts('.monaco-hover:not(.hidden) .hover-row')).join(' '),
    'there is no hover',
    (hover) => hover.includes('ISO035') && /G40/.test(hover) && /compensation/i.test(hover),
  );
  await editor.press('Escape');
});

test('a quick fix mends the line', async () => {
  await editor.goTo(50, 8);
  await editor.press('Control+.');
  await page.locator('.action-widget .monaco-list-row.focused', { hasText: 'M06' }).first().waitFor();
  await editor.press('Enter');
  await lineBecomes(50, /^N440 M06 T102003/, 'the fix is not made');
  await eventually(problems, 'the problem stays', (rows) => rows.length > 0 && !isListed('ISO054')(rows));
});

test('what is typed is completed', async () => {
  await editor.goTo(50, 99);
  await editor.press('Enter');
  await page.keyboard.type('arc-c');
  await editor.press('Control+Space');
  await page.locator('.suggest-widget.visible .monaco-list-row', { hasText: 'arc-center' }).first().waitFor();
  await editor.press('Enter');
  await lineBecomes(51, /^G02 X0 Y0 I0 J0/, 'the snippet is not there');
  await editor.press('Escape', 'Escape', 'Control+z', 'Control+z', 'Control+z');
});

test('a program is formatted', async () => {
  await editor.open('registers.iso');
  await editor.goTo(5, 4);
  await page.keyboard.type('   ');
  await lineBecomes(5, /^G00 {4}X0/, 'nothing is typed');
  await editor.command('Format Document');
  await lineBecomes(5, /^G00 X0 Y0 Z20\s*$/, 'the line is not formatted');
  await editor.command('File: Revert File');
});

test('what is typed is compared with what is saved; a page has no HEAD', async () => {
  await editor.open('registers.iso');
  await editor.goTo(6, 99);
  await page.keyboard.type('0');
  await lineBecomes(6, /F10000/, 'nothing is typed');
  await editor.command('ISOCNC: Compare Behavior with Saved');
  const lenses = () => editor.texts('.monaco-diff-editor .editor.modified .codelens-decoration');
  await eventually(lenses, 'the lens is not there', (texts) => /F10000 instead of F1000/.test(texts.join()));
  await editor.press('Control+F4');
  await editor.open('registers.iso');
  await editor.command('File: Revert File');
  await editor.command('ISOCNC: Compare Behavior with HEAD');
  await eventually(() => editor.texts('.notification-toast'), 'no message', (texts) => texts.some((text) => text.includes('There is no HEAD here')));
  await editor.command('Notifications: Clear All Notifications');
});

test('the machine is that of isocnc.json, also when it changes', async () => {
  await editor.open('travel.iso');
  await editor.command('Problems: Focus on Problems View');
  await eventually(problems, 'X4000 is not beyond the machine', (rows) => rows.some((row) => /4000/.test(row)));
  await editor.open('isocnc.json');
  const column = (await editor.lineText(5)).indexOf('3250') + 5;
  await editor.goTo(5, column);
  await page.keyboard.type('0');
  await lineBecomes(5, /32500/, 'nothing is typed');
  await editor.press('Control+s');
  await eventually(problems, 'X4000 is still beyond the machine', (rows) => !rows.some((row) => /4000/.test(row)));
});

test('a task lists the problems of programs that are not open', async () => {
  await eventually(
    async () => {
      await editor.press('Escape', 'Control+p');
      await page.locator('.quick-input-widget input').first().fill('task check parts');
      await page.locator('.quick-input-list .monaco-list-row.focused', { hasText: 'check parts' }).waitFor({ timeout: 5000 });
      await editor.press('Enter');
      return true;
    },
    'there is no task',
  );
  await eventually(() => editor.texts('.terminal-wrapper.active .xterm-rows'), 'the task reports nothing', (rows) => /closed\.iso:2:1/.test(rows.join()));
  await editor.command('Problems: Focus on Problems View');
  await eventually(problems, 'the task finds nothing', (rows) => rows.some((row) => /^closed\.iso/.test(row)));
});

test('a program is checked from the menu of its file', async () => {
  await editor.chooseInExplorer(['broken.iso'], 'Check with isolint');
  const shown = () => editor.texts('.terminal-wrapper.active .xterm-rows');
  await eventually(shown, 'the task reports nothing', (rows) => /broken\.iso:65:19.*exit code: 1/s.test(rows.join()));
  assert.doesNotMatch((await shown()).join(), /failed to launch/);
});

test('a program runs on the simulator, in a terminal', async () => {
  await editor.open('pocket.iso');
  await editor.focus();
  await editor.press('Control+Alt+r');
  await eventually(() => editor.texts('.terminal-wrapper.active .xterm-rows'), 'nothing has been run', (rows) => /cycle time: 46\.1 s/.test(rows.join()));
});

test('the plot of a program is written where the user says', async () => {
  await editor.open('registers.iso');
  await editor.focus();
  await editor.press('Control+Alt+p');
  const input = page.locator('.quick-input-widget:not([style*="display: none"]) input').first();
  await eventually(() => input.inputValue(), 'it does not ask for the file', (path) => /registers\.html$/.test(path ?? ''));
  await editor.press('Enter');
  await eventually(() => editor.texts('.notification-toast'), 'it is not reported', (texts) => texts.some((each) => /Written: registers\.html/.test(each)));
  await editor.command('Notifications: Clear All Notifications');
  await page.locator('.explorer-folders-view .monaco-list-row', { hasText: 'registers.html' }).first().waitFor();
});

test('the toolpath shows the moves of the program, and follows the cursor and the text', async () => {
  await editor.open('pocket.iso');
  await editor.hidePanel();
  await editor.command('ISOCNC: Show Toolpath');
  const frame = await editor.toolpath();
  const { steps, hasView } = await frame.evaluate(() => ({ steps: globalThis.isocnc.path.stepCount, hasView: globalThis.isocnc.view !== null }));
  assert.ok(hasView);
  assert.ok(steps > 50, `${steps} steps`);
  await editor.focus();
  await editor.goTo(22);
  await eventually(() => editor.litLine(), 'line 22 does not light up', (line) => line === 22);
  await editor.keepPicture('web');
  const furthest = () => frame.evaluate(() => globalThis.isocnc.path.work.max[0]);
  const reached = await furthest();
  await editor.goTo(25, 99);
  await page.keyboard.type('5');
  await eventually(furthest, 'the toolpath stays', (now) => now > reached + 500);
  await editor.press('Control+z');
});

test('F5 runs the open program; steps go forward and back, and the tool with them', async () => {
  await editor.open('registers.iso');
  const tabs = page.locator('.tab[data-resource-name="registers.iso"]');
  const opened = await tabs.count();
  await editor.goTo(8);
  await editor.press('F9');
  await page.locator('.codicon-debug-breakpoint').first().waitFor();
  await editor.startDebugging();
  await eventually(() => editor.stoppedAt(), 'it does not stop at the first block', (line) => line === 2);
  await editor.unfold('Registers');
  await editor.focus();
  await editor.press('F5');
  await eventually(() => editor.stoppedAt(), 'it does not stop at the breakpoint', (line) => line === 8);
  await eventually(() => editor.variables(), 'V1 is not 7', (rows) => rows.some((row) => /V1\D.*7/.test(row)));
  await editor.step('F10', 9);
  const frame = await editor.toolpath();
  await eventually(
    () => frame.evaluate(() => globalThis.isocnc.path.at(globalThis.isocnc.player.time).tip[0]),
    'the tool is not at X50, where line 8 has led it',
    (x) => Math.abs(x - 50) < 0.2,
  );
  for (const line of [8, 7]) {
    await page.locator('.debug-toolbar .codicon-debug-step-back').click();
    await eventually(() => editor.stoppedAt(), 'it does not step back', (now) => now === line);
  }
  await eventually(() => editor.variables(), 'V1 is not 2.5 again', (rows) => rows.some((row) => /V1\D.*2\.5/.test(row)));
  // The source is the file of the page's file system, not another one of its name.
  assert.equal(await tabs.count(), opened);
  await editor.press('Shift+F5');
  await page.locator('.debug-toolbar').waitFor({ state: 'hidden' });
});

test('a program that restarts is made beside the program', async () => {
  await editor.open('pocket.iso');
  await editor.goTo(30);
  await editor.command('ISOCNC: Write Program That Restarts from Here');
  await page.locator('.tab[data-resource-name="pocket-from-30.iso"]').first().waitFor();
});

test('the page has been given files, and nothing else', async () => {
  assert.ok(editor.requests.includes('/extension/dist/web/isocnc.wasm'));
  assert.deepEqual(editor.requests.filter((path) => path.startsWith('/extension/bin') || path === '/extension/dist/extension.js'), []);
});

test('nothing has gone wrong in the extension host', async () => {
  assert.deepEqual((await editor.texts('.notification-toast')).filter((each) => /failed|error/i.test(each)), []);
  const lines = editor.messages.filter((line) => /isocnc\.isocnc/i.test(line) && /\b(TypeError|ReferenceError|failed)\b/.test(line));
  assert.deepEqual(lines, []);
});

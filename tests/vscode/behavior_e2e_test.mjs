// What two versions of a program do otherwise, in a real VS Code: diffs with HEAD of a real Git repository, with what is saved and
// with a file; the debugger's first difference. With ISOCNC_SCREENSHOTS=FOLDER it leaves a picture there, which docs/images/ has.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, afterEach, test } from 'node:test';
import { Editor, eventually, root } from './editor.mjs';

const { ISOCNC_VSIX: extension, ISOCNC_CODE_SERVER: codeServer } = process.env;
const hasDebugger = existsSync(join(root, 'build/vscode-extension/stage/bin/isodap'));

assert.ok(extension && codeServer, 'ISOCNC_VSIX and ISOCNC_CODE_SERVER name the package and the editor: start tests/vscode/run');
const editor = await Editor.start({ codeServer, extension });
const { page } = editor;

const committed = readFileSync(join(root, 'examples/pocket.iso'), 'utf8');
/** The pocket is 0.2 mm deeper, and its finish is fed faster. */
const changed = committed.replaceAll('Z-12', 'Z-12.2').replace('F4500', 'F5000');
const renumbered = committed.replace(/^N(\d+)/gm, (_, number) => `N${Number(number) / 2}`);
assert.ok(changed !== committed && renumbered !== committed);

const git = (...args) =>
  execFileSync('git', ['-c', 'user.name=A', '-c', 'user.email=a@b.c', '-c', 'commit.gpgsign=false', ...args], { cwd: editor.workspace, encoding: 'utf8' });
editor.add('pocket.iso', committed);
editor.add('numbers.iso', committed);
writeFileSync(join(editor.workspace, '.gitignore'), '.vscode\n');
git('init', '--quiet', '--initial-branch', 'main');
git('add', '.');
git('commit', '--quiet', '--message', 'as on the machine');
editor.add('pocket.iso', changed);
editor.add('numbers.iso', renumbered);
editor.add('new.iso', changed);
editor.add('before.iso', committed.replace('X186', 'X180'));
await editor.openWorkbench();

after(async () => {
  await editor.stop();
});
afterEach((context) => editor.showFailure(context));

/** The lenses of the diff in front. */
const lenses = () => editor.texts('.monaco-diff-editor .editor.modified .codelens-decoration');
const lensesAre = (what, isRight) => eventually(lenses, what, (texts) => isRight(texts.join(' | ')));
const noticed = (text) => eventually(() => editor.texts('.notification-toast'), `no notice ${text}`, (texts) => texts.some((each) => text.test(each)));
const clear = () => editor.command('Notifications: Clear All Notifications');
const close = () => editor.press('Control+F4');

test('lenses say what each hunk does otherwise than HEAD', async () => {
  await editor.open('pocket.iso');
  await editor.command('ISOCNC: Compare Behavior with HEAD');
  await page.locator('.monaco-diff-editor').waitFor();
  const texts = await lensesAre('the lenses are not there', (all) => /T101001: moved by Z-0\.2/.test(all));
  assert.match(texts.join(), /T101001: moved by Z-0\.2 ?\| ?3 differences, -\d+\.\d s/);
  assert.ok(!texts.join().includes('debug from here'), 'lenses of the server are in the way');
});

test('the next hunk has its lenses, too', async () => {
  await editor.press('Alt+F5');
  await lensesAre('the change of the feed is not named', (all) => /T102003: moved by Z-0\.2/.test(all) && /T102003: F5000 instead of F4500/.test(all));
  await editor.press('Control+b');
  await editor.keepPicture('behavior');
  await editor.press('Control+b');
});

test('the toolpath shows both programs of a diff', async () => {
  await editor.command('ISOCNC: Show Toolpath');
  const frame = await editor.toolpath();
  const compared = () => frame.evaluate(() => globalThis.isocnc.comparison?.changes.map(({ text }) => text.en) ?? null);
  await eventually(compared, 'the old path is not there', (texts) => texts?.includes('F5000 instead of F4500'));
  assert.ok(await frame.evaluate(() => globalThis.isocnc.comparison.paths.old.seconds > globalThis.isocnc.path.seconds));
  await editor.keepPicture('compared');
  await frame.locator('#change-list [role=option]').first().click();
  const shown = async () => {
    await editor.focus();
    return editor.place();
  };
  await eventually(shown, 'the line of the change is not shown', ({ line }) => line === 31);
  // The program alone.
  await editor.open('numbers.iso');
  await eventually(compared, 'the old path stays', (texts) => texts === null);
  await editor.open('pocket.iso');
  await editor.command('ISOCNC: Compare Behavior with HEAD');
  await eventually(compared, 'the old path does not come back', (texts) => texts?.length === 3);
});

test('lenses follow what is typed in the diff', async () => {
  await editor.press('Control+Home');
  await page.keyboard.type('M100\n');
  await lensesAre('the lenses do not follow', (all) => /added: M100(, [+-][\d.]+ s)? ?\| ?4 differences/.test(all));
  await editor.command('File: Revert File');
  await lensesAre('the lens stays', (all) => !all.includes('M100'));
  await close();
});

test('a program that is only renumbered makes no difference, and a message says so', async () => {
  await editor.open('numbers.iso');
  await editor.command('ISOCNC: Compare Behavior with HEAD');
  await noticed(/numbers\.iso \(HEAD ↔ now\): no difference in what the machine does/);
  await lensesAre('no lens says so', (all) => all === 'no difference in what the machine does');
  await clear();
  await close();
});

test('a diff that Git opens has the lenses, too', async () => {
  await editor.open('pocket.iso');
  await page.locator('.editor-actions .action-label[aria-label^="Open Changes"]').first().click();
  await page.locator('.monaco-diff-editor').waitFor();
  await lensesAre('the lenses are not there', (all) => /T101001: moved by Z-0\.2/.test(all));
  await close();
});

test('a program that HEAD does not have is not compared, and a message says why', async () => {
  await editor.open('new.iso');
  await editor.command('ISOCNC: Compare Behavior with HEAD');
  await noticed(/HEAD has no new\.iso/);
  assert.equal(await page.locator('.monaco-diff-editor').count(), 0);
  await clear();
});

test('what is typed is compared with what is saved', async () => {
  await editor.open('new.iso');
  await editor.goTo(12, 99);
  await page.keyboard.type('0');
  await eventually(() => editor.lineText(12), 'nothing is typed', (text) => /F25000/.test(text ?? ''));
  await editor.command('ISOCNC: Compare Behavior with Saved');
  await lensesAre('the lens is not there', (all) => /T101001: F25000 instead of F2500(, [+-][\d.]+ s)? ?\| ?1 difference/.test(all));
  await editor.press('Control+s');
  await lensesAre('saving makes no difference', (all) => all === 'no difference in what the machine does');
  await close();
});

test('a program is compared with a file that is chosen', async () => {
  await editor.open('numbers.iso');
  await editor.command('ISOCNC: Compare Behavior with File');
  const input = page.locator('.quick-input-widget:not([style*="display: none"]) input').first();
  await eventually(() => input.inputValue(), 'it does not ask for the file', (path) => /parts/.test(path ?? ''));
  await input.fill(join(editor.workspace, 'before.iso'));
  await editor.press('Enter');
  await lensesAre('the lens is not there', (all) => /T101001: moved by X6(, [+-][\d.]+ s)? ?\| ?1 difference/.test(all));
  await close();
});

test('two programs that are selected in the Explorer are compared', async () => {
  await editor.chooseInExplorer(['before.iso', 'numbers.iso'], 'Compare Behavior with File');
  await lensesAre('the lens is not there', (all) => /T101001: moved by X6/.test(all));
  await close();
});

test('the debugger runs to the first difference from HEAD', { skip: hasDebugger ? false : 'there is no isodap in the package' }, async () => {
  await editor.open('pocket.iso');
  await editor.startDebugging();
  await eventually(() => editor.stoppedAt(), 'it does not stop at the first block', (line) => line === 4);
  await editor.command('ISOCNC: Run to First Difference');
  await page.locator('.quick-input-list .monaco-list-row', { hasText: 'HEAD' }).first().waitFor();
  await editor.press('Enter');
  const first = changed.split('\n').findIndex((line) => line.includes('X172 Z-12.2')) + 1;
  await eventually(() => editor.stoppedAt(), 'it does not run to the difference', (line) => line === first);
  await eventually(
    () => editor.texts('.call-stack-state-message'),
    'it does not say why it has stopped',
    (texts) => /first difference: moved by Z-0\.2, lines? \d+(-\d+)? of pocket\.iso \(HEAD\)/.test(texts.join()),
  );
  await editor.press('Shift+F5');
});

// The packaged extension in a real VS Code in a real browser, as its users have it: what is on the page is what counts.
// With ISOCNC_SCREENSHOTS=FOLDER it leaves pictures there, which docs/images/ has.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, afterEach, test } from 'node:test';
import { Editor, eventually, root } from './editor.mjs';

const { ISOCNC_VSIX: extension, ISOCNC_CODE_SERVER: codeServer } = process.env;
const hasDebugger = existsSync(join(root, 'build/vscode-extension/stage/bin/isodap'));
const withDebugger = { skip: hasDebugger ? false : 'there is no isodap in the package: build it first' };

const plate = `; plate
N10 G17 G71 G90 G94
N20 M06 T101001
N30 S16000 M03
N40 G00 X0 Y0 Z30
N50 Z2
N60 G01 Z-3 F1500
N70 X100 F6000
N80 G03 X110 Y10 I100 J10
N90 G01 Y60
N100 X0
N110 Y0
N120 G00 Z30
N130 M06 T102003
N140 S12000 M03
N150 G00 X50 Y30
N160 G01 Z-3 F1200
N170 G00 Z30
N180 M05
N190 M02
`;
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

assert.ok(extension && codeServer, 'ISOCNC_VSIX and ISOCNC_CODE_SERVER name the package and the editor: start tests/vscode/run');
// Without an editor there is nothing to test.
const editor = await Editor.start({ codeServer, extension });
const { page } = editor;

/** The folder of a script that stands for a program. */
function program(folder, name, script) {
  const path = join(editor.folder, folder);
  mkdirSync(path);
  writeFileSync(join(path, name), `#!${process.execPath}\n${script}\n`, { mode: 0o755 });
  return path;
}

/** It answers to initialize, and knows nothing else. */
const oldServer = `
let bytes = Buffer.alloc(0);
const answer = ({ id, method }) =>
  method === 'initialize' ? { result: { capabilities: {}, serverInfo: { name: 'isols', version: '0.0.9' } } }
  : method === 'shutdown' ? { result: null }
  : { error: { code: -32601, message: 'unknown' } };
process.stdin.on('end', () => process.exit());
process.stdin.on('data', (data) => {
  bytes = Buffer.concat([bytes, data]);
  for (let end; (end = bytes.indexOf('\\r\\n\\r\\n')) >= 0; ) {
    const length = Number(/Content-Length: (\\d+)/.exec(bytes.subarray(0, end))[1]);
    if (bytes.length < end + 4 + length) return;
    const message = JSON.parse(bytes.subarray(end + 4, end + 4 + length));
    bytes = bytes.subarray(end + 4 + length);
    if (message.method === 'exit') process.exit();
    if (message.id === undefined) continue;
    const text = JSON.stringify({ jsonrpc: '2.0', id: message.id, ...answer(message) });
    process.stdout.write('Content-Length: ' + Buffer.byteLength(text) + '\\r\\n\\r\\n' + text);
  }
});`;

for (const name of ['start-here.iso', 'isocnc.json']) editor.add(name, join(root, 'vscode-extension/test-drive', name));
for (const name of ['pocket.iso', 'five-axis.iso']) editor.add(name, join(root, 'examples', name));
mkdirSync(join(editor.workspace, 'setup'));
for (const name of ['isocnc.json', 'block.stl', 'form.stl']) editor.add(`setup/${name}`, join(root, 'examples/setups', name));
editor.add('setup/panel.iso', join(root, 'examples/setups/broken/panel.iso'));
editor.add('plate.iso', plate);
editor.add('registers.iso', registers);
// Never opened: what is reported of it comes from tasks.
editor.add('closed.iso', 'G71 G90\nG05 X1\nM02\n');
editor.add('chosen.iso', 'G71 G90\nG05 X1\nM02\n');
editor.add('new.iso', 'G71 G90\nM06 T101001\nG00 X10 Y5\nM02\n');
editor.add('old.iso', 'g71  g90\nm06t101001\nG00 X10 Y4\nM02\n');
for (const [day, depth] of [['monday', 4], ['tuesday', 5]]) {
  mkdirSync(join(editor.workspace, day, 'doors'), { recursive: true });
  editor.add(`${day}/same.iso`, 'M06 T101001\nM02\n');
  editor.add(`${day}/doors/posted.iso`, `G71 G90 G94\nM06 T101001\nS12000 M03\nG00 X10 Y5 Z30\nG01 Z-${depth} F1000\nM05\nM02\n`);
}
editor.add('tuesday/doors/past-travel.iso', 'G71 G90\nM06 T101001\nG00 X9000\nM02\n');
editor.add('program.tap', 'G71 G90\nM06 T101001\nM02\n');
editor.add('notes.tap', 'feeds to try\nM06 T101001\n');
await editor.openWorkbench();

after(async () => {
  await editor.stop();
});
afterEach((context) => editor.showFailure(context));

const hidePanel = () => editor.hidePanel();

/** A file of the workspace's settings. */
function writeInFolder(name, content) {
  const folder = join(editor.workspace, '.vscode');
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, name), JSON.stringify(content));
}
const writeSettings = (settings) => writeInFolder('settings.json', settings);

const notices = () => editor.texts('.notification-toast');
const squiggles = () => editor.squiggles();
const problems = () => editor.problems();

test('what would stop the control is underlined and listed among the problems', async () => {
  await editor.open('start-here.iso');
  await eventually(squiggles, 'nothing is underlined', (count) => count >= 3);
  await editor.command('Problems: Focus on Problems View');
  const listed = await eventually(problems, 'the problems are not listed', (rows) => rows.some((row) => row.includes('ISO031')));
  for (const code of ['ISO031', 'ISO054', 'ISO006', 'W001']) assert.ok(listed.some((row) => row.includes(code)), `${code} in ${listed}`);
  assert.match(listed.find((row) => row.includes('ISO031')), /it is 11\.1803 mm from the start and 15 mm from the end/);
});

/** Starts a task until its problems are listed: VS Code may lose those of a task that ends at once, on a busy machine. */
async function listedByTask(start, program, line = 2) {
  const listed = async () => {
    await eventually(start, 'the task does not start', () => true);
    // The terminal comes to the front with the task.
    await eventually(() => editor.texts('.terminal-wrapper.active .xterm-rows'), 'the task reports nothing', (texts) => texts.join().includes(`${program}:${line}:1`));
    await editor.command('Problems: Focus on Problems View');
    await page.locator('.markers-panel .monaco-list-row', { hasText: program }).first().waitFor({ timeout: 8000 });
    return problems();
  };
  await eventually(listed, `${program} is not listed`, (rows) => rows.some((row) => row.startsWith(program)));
}

test('a program is checked from the menu of its file', async () => {
  await listedByTask(() => editor.chooseInExplorer(['new.iso', 'chosen.iso'], 'Check with isolint'), 'chosen.iso');
  await hidePanel();
});

test('all programs of a folder are checked, or run on the machine, from its menu', async () => {
  await listedByTask(() => editor.chooseInExplorer(['tuesday'], 'Run on the Simulator'), 'past-travel.iso', 3);
  const rows = await problems();
  assert.ok(rows.some((row) => row.includes('E160')), rows.join('; '));
  await hidePanel();
});

test('programs of two folders are compared by what they do', async () => {
  await editor.chooseInExplorer(['monday', 'tuesday'], 'Compare Behavior with Folder...');
  const rows = page.locator('.quick-input-list .monaco-list-row');
  await rows.nth(1).waitFor();
  const listed = await editor.texts('.quick-input-list .monaco-list-row');
  assert.equal(listed.length, 2, listed.join('; '));
  await rows.filter({ hasText: 'doors/posted.iso' }).click();
  await eventually(() => editor.texts('.codelens-decoration'), 'the change has no lens', (texts) => texts.some((text) => /Z-1/.test(text)));
  await editor.press('Control+F4');
  await editor.open('start-here.iso');
});

test('two programs are compared as they would be formatted', async () => {
  await editor.chooseInExplorer(['old.iso', 'new.iso'], 'Compare Programs');
  const side = (name) => editor.texts(`.monaco-diff-editor .editor.${name} .view-line`);
  const [left, right] = await eventually(
    async () => [await side('original'), await side('modified')],
    'the programs are not compared',
    ([a, b]) => a.some((line) => line.includes('Y4')) && b.some((line) => line.includes('Y5')),
  );
  assert.ok(left.some((line) => line.replaceAll('\u00a0', ' ').includes('M06 T101001')), left.join('; '));
  assert.equal(left.length, right.length);
  await eventually(() => page.locator('.monaco-diff-editor .editor.modified .line-insert').count(), 'blanks and case show as differences', (count) => count === 1);
  await editor.press('Control+F4');
  await editor.open('start-here.iso');
});

test('the colors of the dialect are there', async () => {
  const colorOf = (text) =>
    page.evaluate((wanted) => {
      const spans = [...document.querySelectorAll('.editor-instance .view-line span span')];
      const span = spans.find((each) => each.textContent.replaceAll('\u00a0', ' ').trim() === wanted);
      return span ? getComputedStyle(span).color : null;
    }, text);
  await editor.focus();
  await eventually(() => colorOf('G03'), 'G03 has no color');
  const colors = await eventually(
    async () => [await colorOf('G03'), await colorOf('T101001'), await colorOf('N90')],
    'motion, tool and line number have one color',
    (all) => !all.includes(null) && new Set(all).size === 3,
  );
  assert.equal(colors.length, 3);
});

test('a hover shows what a word means, and what is wrong', async () => {
  await editor.focus();
  await editor.goTo(16, 22);
  await editor.press('Control+k', 'Control+i');
  const text = await eventually(
    async () => (await editor.texts('.monaco-hover:not(.hidden) .hover-row')).join(' '),
    'there is no hover',
    (hover) => hover.includes('ISO031') && /radius|center/i.test(hover),
  );
  assert.match(text, /15 mm/);
  await editor.keepPicture('editor');
  await editor.press('Escape');
});

test('the outline has the tool sections', async () => {
  await editor.command('Explorer: Focus on Outline View');
  const rows = await eventually(() => editor.texts('.outline-tree .monaco-list-row'), 'the outline is empty', (all) => all.length > 1);
  assert.ok(rows.some((row) => /T101001/.test(row)), rows.join('; '));
});

test('a quick fix mends the line', async () => {
  await editor.focus();
  await editor.goTo(24, 8);
  await editor.press('Control+.');
  // The preferred one comes first, and has the focus.
  await page.locator('.action-widget .monaco-list-row.focused', { hasText: 'M06' }).first().waitFor();
  await editor.press('Enter');
  await eventually(() => editor.lineText(24), 'the fix is not made', (text) => /^N180 M06 T102003/.test(text ?? ''));
  await eventually(problems, 'the problem stays', (rows) => !rows.some((row) => row.includes('ISO054')));
});

test('what is typed is completed', async () => {
  await editor.focus();
  await editor.goTo(27, 99);
  await editor.press('Enter');
  await page.keyboard.type('arc-c');
  await editor.press('Control+Space');
  await page.locator('.suggest-widget.visible .monaco-list-row', { hasText: 'arc-center' }).first().waitFor();
  await editor.press('Enter');
  await eventually(() => editor.lineText(28), 'the snippet is not there', (text) => /^G02 X0 Y0 I0 J0/.test(text ?? ''));
  await editor.press('Escape', 'Escape', 'Control+z', 'Control+z', 'Control+z');
});

test('a register has its new name everywhere', async () => {
  await editor.open('registers.iso');
  await editor.goTo(4, 2);
  await editor.press('F2');
  const input = page.locator('.rename-box input');
  await input.waitFor();
  await input.fill('V9');
  await editor.press('Enter');
  await eventually(async () => [await editor.lineText(4), await editor.lineText(7), await editor.lineText(9)], 'nothing is renamed', (lines) =>
    lines.every((line) => line?.includes('V9')),
  );
  await editor.press('Control+z');
  await eventually(() => editor.lineText(4), 'the renaming is not undone', (text) => /^V1 = 2\.5/.test(text ?? ''));
});

test('a program is formatted', async () => {
  await editor.open('plate.iso');
  await editor.goTo(5, 5);
  await page.keyboard.type('   ');
  await eventually(() => editor.lineText(5), 'nothing is typed', (text) => /^N40 {4}G00/.test(text ?? ''));
  await editor.command('Format Document');
  await eventually(() => editor.lineText(5), 'the line is not formatted', (text) => text?.trimEnd() === 'N40 G00 X0 Y0 Z30');
  await editor.press('Control+z');
});

test('commands walk through the tool changes, and renumber', async () => {
  await editor.open('plate.iso');
  await editor.command('File: Revert File');
  await editor.goTo(1);
  await editor.press('Control+Alt+n');
  assert.equal((await eventually(() => editor.place(), 'the cursor stays', ({ line }) => line === 3)).line, 3);
  await editor.press('Control+Alt+n');
  await eventually(() => editor.place(), 'the cursor stays', ({ line }) => line === 14);
  await editor.press('Control+Alt+b');
  await eventually(() => editor.place(), 'the cursor stays', ({ line }) => line === 3);
  await editor.goTo(2);
  await editor.press('Home', 'Control+d');
  await editor.command('ISOCNC: Show State Here');
  await eventually(
    async () => (await page.locator('.editor-instance').allInnerTexts()).join('\n').replaceAll('\u00a0', ' '),
    'the state does not show',
    (text) => /arc plane/.test(text) && /G17/.test(text) && /before\s+after/.test(text),
  );
  await editor.focus();
});

/** A toolpath that has taken in what the editor has: another one than before. */
const generation = async () => Number(await (await editor.toolpath()).evaluate(() => document.documentElement.dataset.ready));

test('the toolpath shows the moves of the program', async () => {
  await editor.open('pocket.iso');
  await hidePanel();
  await editor.command('ISOCNC: Show Toolpath');
  const frame = await editor.toolpath();
  const { steps, hasView } = await frame.evaluate(() => ({ steps: globalThis.isocnc.path.stepCount, hasView: globalThis.isocnc.view !== null }));
  assert.ok(hasView);
  assert.ok(steps > 50, `${steps} steps`);
  assert.match(await frame.locator('#totals').innerText(), /time/);
  await eventually(() => editor.texts('#isocnc\\.isocnc\\.isocnc\\.cycleTime, .statusbar-item[id*="cycleTime"]'), 'no cycle time', (texts) =>
    texts.some((text) => /\d:\d\d\.\d/.test(text)),
  );
});

const litLine = () => editor.litLine();

test('the move of the line at the cursor lights up', async () => {
  await editor.focus();
  await editor.goTo(22);
  await eventually(litLine, 'line 22 does not light up', (line) => line === 22);
  await editor.press('ArrowDown');
  await eventually(litLine, 'line 23 does not light up', (line) => line === 23);
  await editor.keepPicture('toolpath');
});

test('a click on a move reveals its line', async () => {
  const frame = await editor.toolpath();
  await frame.getByRole('button', { name: 'Top', exact: true }).click();
  const place = await frame.evaluate(() => {
    const { path, view } = globalThis.isocnc;
    // The middle of a long side of the pocket: line 15, X186 Y84.
    const { start, end } = path.stepsOf(15);
    const [from, to] = [path.tipOf(path.stepStart[start]), path.tipOf(path.stepStart[end])];
    return view.project(from.map((value, i) => (value + to[i]) / 2));
  });
  await frame.locator('#stage').click({ position: place });
  const line = await eventually(() => editor.currentLine(), 'no line is revealed', (at) => at !== 23 && at > 0);
  // The same move is made in both passes.
  const isThere = await frame.evaluate((number) => {
    const { path } = globalThis.isocnc;
    const at = (index) => path.tipOf(path.stepStart[path.stepsOf(index).end]).slice(0, 2).join();
    return at(number - 1) === at(15);
  }, line);
  assert.ok(isThere, `line ${line}`);
});

test('the toolpath follows what is typed', async () => {
  const before = await generation();
  const furthest = async () => (await editor.toolpath()).evaluate(() => globalThis.isocnc.path.work.max[0]);
  const reached = await furthest();
  await editor.focus();
  await editor.goTo(25, 99);
  await page.keyboard.type('5');
  await eventually(generation, 'no other toolpath comes', (now) => now > before);
  await eventually(furthest, 'the toolpath stays', (now) => now > reached + 500);
  await editor.press('Control+z');
  await eventually(furthest, 'the toolpath does not come back', (now) => Math.abs(now - reached) < 1e-6);
});

test('the tree of operations has times and findings, leads to lines, and hides parts of the path', async () => {
  const frame = await editor.toolpath();
  await editor.command('Explorer: Focus on Operations View');
  const tree = page.locator('.pane', { has: page.locator('.pane-header[aria-label*="Operations"]') });
  const rows = () => tree.locator('.monaco-list-row').allInnerTexts();
  const shown = await eventually(rows, 'the tree is empty', (texts) => texts.length > 1);
  const [rough, finish] = ['T101001', 'T102003'].map((tool) => tree.locator('.monaco-list-row', { hasText: tool }));
  assert.match(shown.join('; '), /T101001.*\d:\d\d\.\d · \d+(\.\d)? m+ · Z-\d+/s);
  await editor.keepPicture('operations');
  await finish.click();
  const change = await eventually(() => editor.currentLine(), 'its line is not shown', (line) => line > 0 && line !== 25);
  assert.match(await editor.lineText(change), /M06 T102003/);
  const hidden = (line) =>
    frame.evaluate((at) => Boolean(globalThis.isocnc.view.hidden?.[globalThis.isocnc.path.stepsOf(at).start]), line);
  await finish.locator('.custom-view-tree-node-item-checkbox').click();
  await eventually(() => hidden(change + 4), 'the operation is not hidden');
  assert.equal(await hidden(14), false);
  await finish.hover();
  await finish.locator('.action-label[aria-label*="Show Only This"]').click();
  await eventually(() => hidden(14), 'the other operation is not hidden');
  assert.equal(await hidden(change + 4), false);
  await tree.locator('.pane-header').hover();
  await page.locator('.action-label[aria-label*="Show All Operations"]').first().click();
  await eventually(async () => !(await hidden(14)), 'the other operation stays hidden');
  await rough.click();
  await eventually(async () => /M06 T101001/.test(await editor.lineText(await editor.currentLine())), 'the first operation is not shown');
});

test('the machine, its tools and setups are edited in a form, which keeps comments', async () => {
  const text = `{
  // ours
  "machine": {
    "tools": [
      {"head": 1, "holder": 1, "tool": 1, "name": "cutter 20", "length": 120, "radius": 10} // measured in March
    ]
  }
}
`;
  mkdirSync(join(editor.workspace, 'form'));
  editor.add('form/isocnc.json', text);
  editor.add('form/formed.iso', 'G71 G90\nM06 T101001\nM02\n');
  await editor.open('formed.iso');
  await editor.command('ISOCNC: Edit Machine, Tools and Setups in a Form');
  const frame = await eventually(async () => {
    for (const each of page.frames()) if (await each.evaluate(() => document.querySelector('#form')?.childElementCount > 0).catch(() => false)) return each;
    return null;
  }, 'the form does not show');
  const tool = frame.locator('details[id="machine.tools.0"]');
  await tool.locator('summary').first().click();
  const length = frame.locator('input[id="machine.tools.0.length"]');
  assert.equal(await length.inputValue(), '120');
  await length.fill('-4');
  await length.press('Tab');
  assert.equal(await length.getAttribute('aria-invalid'), 'true');
  await length.fill('118,5');
  await length.press('Tab');
  await eventually(() => frame.locator('input[id="machine.tools.0.length"]').inputValue(), 'the length is not taken', (value) => value === '118.5');
  await frame.locator('details[id="machine.tools"] > .part > button').click();
  await frame.locator('details[id="machine.tools.1"] input[id="machine.tools.1.name"]').fill('ball 6');
  await frame.locator('input[id="machine.tools.1.name"]').press('Tab');
  await eventually(() => frame.locator('details[id="machine.tools.1"] > summary').innerText(), 'the tool is not added', (title) => title.includes('T101002 · ball 6'));
  await editor.keepPicture('form');
  await editor.press('Control+s');
  const saved = () => readFileSync(join(editor.workspace, 'form/isocnc.json'), 'utf8');
  const written = await eventually(saved, 'nothing is saved', (now) => now !== text);
  assert.match(written, /\/\/ ours/);
  assert.match(written, /"length": 118\.5[^\n]*\/\/ measured in March/);
  assert.equal(JSON.parse(written.replaceAll(/\/\/.*/g, '')).machine.tools.length, 2);
  // Nothing of it stays: another isocnc.json would be opened in its place, and in the form again.
  await editor.command('View: Close All Editors in Group');
  rmSync(join(editor.workspace, 'form'), { recursive: true });
  await editor.open('plate.iso');
});

test('a program is mirrored by a command, and back', async () => {
  await editor.focus();
  await editor.goTo(14);
  const before = await editor.lineText(14);
  const mirror = async () => {
    await editor.command('ISOCNC: Mirror, Rotate, Shift, Repeat or Scale Feeds...');
    await page.locator('.quick-input-list .monaco-list-row', { hasText: 'Mirror X' }).click();
    await page.locator('.quick-input-box input[placeholder="400"]').waitFor();
    await page.keyboard.type('300');
    await editor.press('Enter');
  };
  await mirror();
  await eventually(() => editor.lineText(14), 'the program is not mirrored', (text) => text && text !== before);
  await mirror();
  await eventually(() => editor.lineText(14), 'the program is not mirrored back', (text) => text === before);
  await editor.command('File: Revert File');
});

test('the run plays, and keys move through it', async () => {
  const frame = await editor.toolpath();
  await frame.locator('#stage').focus();
  await frame.locator('#stage').press('Home');
  await eventually(() => frame.evaluate(() => globalThis.isocnc.player.time), 'the start is not reached', (time) => time === 0);
  await frame.locator('#stage').press('Space');
  await eventually(() => frame.evaluate(() => globalThis.isocnc.player.time), 'the time stands still', (time) => time > 0);
  await frame.locator('#stage').press('Space');
  assert.equal(await frame.evaluate(() => globalThis.isocnc.player.isPlaying), false);
  await frame.getByLabel('Kind').check({ force: true });
  assert.match(await frame.locator('#legend').innerText(), /rapid[\s\S]*feed move[\s\S]*arc/);
});

test('nothing runs in the page but its own script', async () => {
  const frame = await editor.toolpath();
  const policy = await frame.locator('meta[http-equiv="Content-Security-Policy"]').first().getAttribute('content');
  assert.match(policy, /default-src 'none'; script-src 'nonce-[\w+/=]+';/);
  assert.doesNotMatch(policy, /unsafe/);
  await frame.evaluate(() => {
    const script = document.createElement('script');
    script.textContent = 'globalThis.hacked = 1';
    document.body.append(script);
  });
  assert.equal(await frame.evaluate(() => globalThis.hacked), undefined);
});

test('five axes have their tool turned, in the light theme', async () => {
  await editor.open('five-axis.iso');
  await editor.command('Preferences: Toggle between Light/Dark Themes');
  const frame = await editor.toolpath();
  await eventually(() => frame.evaluate(() => document.body.classList.contains('vscode-light')), 'the theme stays dark');
  await eventually(() => frame.evaluate(() => globalThis.isocnc.path.facts.name), 'another program shows', (name) => name.includes('five-axis'));
  const isInSight = () =>
    frame.evaluate(() => {
      const { path, view } = globalThis.isocnc;
      const { min, max } = path.work;
      const { x, y } = view.project(min.map((value, i) => (value + max[i]) / 2));
      return x > 0 && y > 0 && x < view.canvas.clientWidth && y < view.canvas.clientHeight;
    });
  await eventually(isInSight, 'the program is out of sight');
  await editor.focus();
  await editor.goTo(25);
  await eventually(litLine, 'line 25 does not light up', (line) => line === 25);
  assert.ok(await frame.evaluate(() => Math.abs(globalThis.isocnc.path.at(globalThis.isocnc.player.time).b) > 60));
  await frame.getByRole('button', { name: 'Iso', exact: true }).click();
  await editor.keepPicture('five-axis');
  await editor.command('Preferences: Toggle between Light/Dark Themes');
  await eventually(() => frame.evaluate(() => document.body.classList.contains('vscode-dark')), 'the theme stays light');
});

test('the toolpath shows the setup of a program, and leads to what the machine hits', async () => {
  await editor.open('panel.iso');
  const frame = await editor.toolpath();
  await eventually(() => frame.evaluate(() => globalThis.isocnc.path.facts.name), 'another program shows', (name) => name.includes('panel'));
  const entries = frame.locator('#contact-list button');
  await eventually(() => entries.count(), 'the contacts are not there', (count) => count === 4);
  assert.match(await frame.locator('#outcome').innerText(), /4 contacts/);
  await frame.evaluate(() => globalThis.isocnc.view.fit());
  await entries.nth(2).click();
  await eventually(litLine, 'line 21 does not light up', (line) => line === 21);
  assert.equal(await frame.evaluate(() => [...globalThis.isocnc.view.sceneModel.touchedNow.keys()][0]?.name), 'clamp 1');
  // The cursor goes to the line, which the editor shows as an error after its own verification.
  await eventually(() => editor.currentLine(), 'the cursor is elsewhere', (line) => line === 21);
  await eventually(squiggles, 'no contact is underlined', (count) => count > 0);
  // From the line to its contact.
  await editor.focus();
  await editor.goTo(36);
  await eventually(() => entries.nth(3).getAttribute('aria-current'), 'its contact does not light up', (is) => is === 'true');
  await editor.keepPicture('contacts');
});

test('a program runs on the simulator, in the terminal', async () => {
  await editor.open('plate.iso');
  await editor.press('Control+Alt+r');
  await eventually(() => editor.texts('.terminal-wrapper.active, .tabs-list .monaco-list-row'), 'no terminal', (texts) =>
    texts.some((text) => text.length > 0),
  );
  await eventually(() => page.locator('.terminal-wrapper .xterm').count(), 'nothing has been run');
});

test('the plot of a program is written where the user says', async () => {
  await editor.open('plate.iso');
  await editor.focus();
  await editor.press('Control+Alt+p');
  const input = page.locator('.quick-input-widget:not([style*="display: none"]) input').first();
  await eventually(() => input.inputValue(), 'it does not ask for the file', (path) => /plate\.html$/.test(path ?? ''));
  await editor.press('Enter');
  const written = join(editor.workspace, 'plate.html');
  await eventually(() => existsSync(written), 'nothing is written');
  await eventually(() => editor.texts('.notification-toast'), 'it is not reported', (texts) => texts.some((text) => /Written: plate\.html/.test(text)));
  assert.match(readFileSync(written, 'utf8'), /<!doctype html>/i);
  await editor.command('Notifications: Clear All Notifications');
});

test('isocnc.json is validated and completed by its schema', async () => {
  await editor.open('isocnc.json');
  await editor.goTo(3, 99);
  await editor.press('Enter');
  await page.keyboard.type('"homes": 1,');
  await editor.command('Problems: Focus on Problems View');
  await eventually(problems, 'the key is not refused', (rows) => rows.some((row) => /homes/.test(row)));
  await editor.focus();
  await editor.press('Control+z', 'Control+z', 'Control+z');
  await editor.command('File: Revert File');
});

test('the setup of a program is validated by its schema and by isols', async () => {
  editor.add('gear.setup.json', '// as posted\n{"clearance": 3, "fixturs": []}\n');
  await editor.open('gear.setup.json');
  await editor.command('Problems: Focus on Problems View');
  await eventually(problems, 'the key is not refused', (rows) => rows.filter((row) => /fixturs/.test(row)).length >= 2);
  assert.deepEqual((await notices()).filter((text) => /failed/.test(text)), []);
  await editor.focus();
});

test('text of another ending is known by its first line', async () => {
  await editor.open('notes.tap');
  await page.locator('#status\\.editor\\.mode', { hasText: 'Plain Text' }).waitFor();
  await editor.open('program.tap');
  await page.locator('#status\\.editor\\.mode', { hasText: 'ISOCNC' }).waitFor();
});

test('a task lists the problems of programs that are not open', async () => {
  // Without a problemMatcher it has those of the extension's own tasks.
  writeInFolder('tasks.json', { version: '2.0.0', tasks: [{ label: 'check parts', type: 'isocnc', command: 'isolint' }] });
  const run = async () => {
    await editor.press('Escape', 'Control+p');
    await page.locator('.quick-input-widget input').first().fill('task check parts');
    await page.locator('.quick-input-list .monaco-list-row.focused', { hasText: 'check parts' }).waitFor({ timeout: 5000 });
    await editor.press('Enter');
    return true;
  };
  await listedByTask(run, 'closed.iso');
  await hidePanel();
});

test('the server is started anew', async () => {
  await editor.open('start-here.iso');
  await editor.command('ISOCNC: Restart Language Server');
  await eventually(squiggles, 'nothing is underlined after a restart', (count) => count >= 2);
});

const variables = () => editor.variables();
const unfold = (scope) => editor.unfold(scope);
const stoppedAt = () => editor.stoppedAt();
const step = (key, line) => editor.step(key, line);
const startDebugging = () => editor.startDebugging();

test('F5 runs the open program; steps go forward and back', withDebugger, async () => {
  await editor.open('registers.iso');
  await editor.focus();
  await editor.goTo(8);
  await editor.press('F9');
  await page.locator('.codicon-debug-breakpoint').first().waitFor();
  await startDebugging();
  await eventually(stoppedAt, 'it does not stop at the first block', (line) => line === 2);
  await unfold('Registers');
  await editor.focus();
  await editor.press('F5');
  await eventually(stoppedAt, 'it does not stop at the breakpoint', (line) => line === 8);
  await eventually(() => editor.lineText(4), 'the value of V1 is not at the end of the line', (text) => /V1 = 2\.5\s+V1 = 7/.test(text ?? ''));
  await eventually(variables, 'V1 is not 7', (rows) => rows.some((row) => /V1\D.*7/.test(row)));
  await step('F10', 9);
  await page.locator('.debug-toolbar .codicon-debug-step-back').click();
  await eventually(stoppedAt, 'it does not step back', (line) => line === 8);
  await page.locator('.debug-toolbar .codicon-debug-step-back').click();
  await eventually(stoppedAt, 'it does not step back', (line) => line === 7);
  await eventually(variables, 'V1 is not 2.5 again', (rows) => rows.some((row) => /V1\D.*2\.5/.test(row)));
  await editor.keepPicture('debug');
});

test('the toolpath has the tool where the debugger has it', withDebugger, async () => {
  const frame = await editor.toolpath();
  await eventually(() => frame.evaluate(() => globalThis.isocnc.path.facts.name), 'another program shows', (name) => name.includes('registers'));
  await step('F10', 8);
  await step('F10', 9);
  await eventually(
    () => frame.evaluate(() => globalThis.isocnc.path.at(globalThis.isocnc.player.time).tip[0]),
    'the tool is not at X50, where line 8 has led it',
    (x) => Math.abs(x - 50) < 0.2,
  );
});

test('the console carries out MDI blocks, and changes registers', withDebugger, async () => {
  await editor.command('Debug Console: Focus on Debug Console View');
  await page.locator('.repl .monaco-editor').first().click();
  for (const entered of ['V1 = 3', 'G01 X70 F2000', 'G909', 'X']) {
    await page.keyboard.type(entered);
    await editor.press('Enter');
  }
  const rows = () => editor.texts('.repl .monaco-list-row');
  await eventually(rows, 'X is not 70, where the MDI block leads', (texts) => texts.some((row) => /^70(\.0*)?$/.test(row.trim())));
  await unfold('Registers');
  await eventually(variables, 'V1 is not 3', (rows) => rows.some((row) => /V1\D.*3/.test(row)));
  await editor.press('Shift+F5');
  await page.locator('.debug-toolbar').waitFor({ state: 'hidden' });
});

test('F5 says what is missing where there is no debugger', { skip: hasDebugger }, async () => {
  await editor.open('plate.iso');
  await editor.press('F5');
  await eventually(() => editor.texts('.notification-toast, .notifications-toasts .monaco-list-row'), 'no advice', (texts) =>
    texts.some((text) => /isodap did not come with this extension/.test(text)),
  );
  await editor.command('Notifications: Clear All Notifications');
});

test('the walkthrough is about the program that was looked at before', async () => {
  await editor.open('plate.iso');
  await editor.command('Welcome: Open Walkthrough');
  await page.locator('.quick-input-widget input').first().fill('Programs of ISOCNC');
  await page.locator('.quick-input-list .monaco-list-row.focused', { hasText: 'ISOCNC' }).waitFor();
  await editor.press('Enter');
  await page.locator('.getting-started-step', { hasText: 'See where the tool goes' }).first().click();
  await page.locator('.getting-started-step .monaco-button', { hasText: 'Show the toolpath' }).first().click();
  const frame = await editor.toolpath();
  await eventually(() => frame.evaluate(() => globalThis.isocnc.path.facts.name), 'another program shows', (name) => name.includes('plate'));
  assert.deepEqual(await notices(), []);
});

// They need a server of their own, and come after all that needs the real one.
test('a server that is missing or too old is reported', async () => {
  await editor.open('plate.iso');
  writeSettings({ 'isocnc.path': '/nowhere' });
  await eventually(notices, 'nothing is reported', (texts) => texts.some((text) => text.includes('There is no isols in /nowhere, the folder that isocnc.path names.')));
  await editor.command('Notifications: Clear All Notifications');
  writeSettings({ 'isocnc.path': program('old', 'isols', oldServer) });
  await eventually(notices, 'nothing is reported', (texts) => texts.some((text) => /isols 0\.0\.9 is older than this extension/.test(text)));
  await editor.command('Notifications: Clear All Notifications');
});

test('F5 does not wait for a server that never answers', withDebugger, async () => {
  const folder = program('deaf', 'isols', 'process.stdin.resume(); process.stdin.on("end", () => process.exit());');
  symlinkSync(join(root, 'build/vscode-extension/stage/bin/isodap'), join(folder, 'isodap'));
  writeSettings({ 'isocnc.path': folder });
  await editor.openWorkbench();
  await editor.open('plate.iso');
  // The extension's buttons are there: VS Code knows of its debugger.
  await page.locator('.editor-actions .codicon-play').first().waitFor();
  await startDebugging();
  await eventually(stoppedAt, 'it does not stop at the first block', (line) => line === 2);
  await editor.press('Shift+F5');
  await page.locator('.debug-toolbar').waitFor({ state: 'hidden' });
});

test('nothing has gone wrong in the extension host', async () => {
  assert.deepEqual((await notices()).filter((text) => /failed|error/i.test(text)), []);
  const lines = editor.log.split('\n').filter((line) => /isocnc/i.test(line) && /\b(TypeError|ReferenceError|Activating extension .* failed)\b/.test(line));
  assert.deepEqual(lines, []);
});

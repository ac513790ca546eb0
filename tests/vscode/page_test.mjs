// The page of the toolpath's panel, with a simulated editor: what it shows and does when it receives a message, in all
// themes.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { recordingOf as recordingOfMoves } from '../toolpath-view/run.mjs';
import { contacts, sceneRecording } from '../toolpath-view/scene.mjs';
import { encoded, panel } from '../toolpath-view/stock.mjs';
import { viewModule } from './modules.mjs';
import { openPage, recordingOf, postMessage, wholePath, without } from './page.mjs';

const { applied } = await viewModule('streams');

const square = (side) => `M06 T101001
S12000 M03
G92 X100 Y100 Z0
G00 X0 Y0 Z20
G01 Z0 F1200
X${side}
Y${side}
G03 X${side - 20} Y${side + 20} R20
G01 X0 F4000
Y0
G00 Z20
M02
`;

let browser;
let page;
let problems = [];
const post = (message) => postMessage(page, message);
const said = () => page.evaluate(() => globalThis.said.splice(0));
const drawn = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const now = () =>
  page.evaluate(() => {
    const { path, player } = globalThis.isocnc;
    return { line: path.stepLine[player.step] + 1, tip: path.at(player.time).tip, max: path.work.max };
  });

before(async () => {
  if (!without) ({ browser, page, problems } = await openPage());
});
after(async () => {
  await browser?.close();
});

const shown = { skip: without };

test('it says that it is ready, and what has gone wrong', shown, async () => {
  assert.deepEqual(await said(), [{ type: 'ready' }]);
  await post({ type: 'problem', message: 'no isols <b>' });
  assert.equal(await page.locator('.problem').innerText(), 'no isols <b>');
});

test('it shows a path, and highlights the lines that a message names', shown, async () => {
  await post(wholePath('1', recordingOf(square(200))));
  assert.equal(await page.locator('.problem').count(), 0);
  await post({ type: 'lines', first: 5, last: 5 });
  // The corner is rounded by the look-ahead.
  assert.ok((await now()).tip.every((value, i) => Math.abs(value - [300, 100, 0][i]) < 0.1), String((await now()).tip));
  const one = await page.locator('#totals').innerText();
  await post({ type: 'lines', first: 5, last: 7 });
  const three = await page.locator('#totals').innerText();
  assert.match(three, /selection/);
  assert.notEqual(three, one);
  await post({ type: 'lines', first: 2, last: 2 });
  assert.deepEqual((await now()).line, 8, 'a line without a move leaves the tool where it is');
});

test('it takes in what an edit has changed, and asks again where it has something else', shown, async () => {
  const [old, next] = [recordingOf(square(200)), recordingOf(square(300))];
  const patches = Object.fromEntries(
    ['steps', 'points', 'turns'].map((name) => {
      const [from, to] = [old[name], next[name]].map((text) => Buffer.from(text, 'base64'));
      let start = 0;
      while (start < from.length && start < to.length && from[start] === to[start]) ++start;
      const patch = { start, removed: from.length - start, data: to.subarray(start) };
      assert.deepEqual(applied({ [name]: from, steps: from, points: from, turns: from }, {}, { steps: patch, points: patch, turns: patch }).steps, new Uint8Array(to));
      return [name, { ...patch, data: patch.data.toString('base64') }];
    }),
  );
  await post({ type: 'path', resultId: '2', previousResultId: '1', facts: next.facts, language: 'en', patches });
  assert.deepEqual((await now()).max.slice(0, 2), [400, 420]);
  assert.deepEqual(await said(), []);
  await post({ type: 'path', resultId: '9', previousResultId: '8', facts: next.facts, language: 'en', patches });
  assert.deepEqual(await said(), [{ type: 'resend' }]);
  assert.deepEqual((await now()).max.slice(0, 2), [400, 420]);
});

test('a click on a move reports its line', shown, async () => {
  await page.getByRole('button', { name: 'Top', exact: true }).click();
  await drawn();
  const position = await page.evaluate(() => globalThis.isocnc.view.project([250, 100, 0]));
  await page.locator('#stage').click({ position });
  assert.deepEqual(await said(), [{ type: 'picked', line: 5 }]);
  assert.equal((await now()).line, 6);
});

test('the tool goes where the debugger has it', shown, async () => {
  await post({ type: 'pose', line: 5, tip: [270, 100, 0], b: 0, c: 0, seconds: 0 });
  const { line, tip } = await now();
  assert.equal(line, 6);
  assert.ok(Math.abs(tip[0] - 270) < 0.01, String(tip));
  const before = await page.locator('#stage').screenshot();
  // Beside the path: the tool is there all the same.
  await post({ type: 'pose', line: 5, tip: [250, 300, 0], b: 0, c: 0, seconds: 0 });
  await drawn();
  assert.notDeepEqual(await page.locator('#stage').screenshot(), before);
});

test('the stock has the size that a message gives', shown, async () => {
  await page.getByRole('button', { name: 'Iso', exact: true }).click();
  await drawn();
  const before = await page.locator('#stage').screenshot();
  await post({ type: 'stock', size: [320, 350, 40] });
  await drawn();
  assert.notDeepEqual(await page.locator('#stage').screenshot(), before);
});

test('it has the colors of the theme', shown, async () => {
  const pictures = new Set();
  for (const name of ['vscode-dark', 'vscode-light', 'vscode-high-contrast vscode-high-contrast-light', 'vscode-high-contrast']) {
    await page.evaluate((classes) => (document.body.className = classes), name);
    await drawn();
    await drawn();
    pictures.add((await page.locator('#stage').screenshot()).toString('base64'));
    const background = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    assert.equal(background, { 'vscode-dark': 'rgb(31, 31, 31)', 'vscode-high-contrast': 'rgb(0, 0, 0)' }[name] ?? 'rgb(255, 255, 255)', name);
    if (process.env.ISOCNC_SCREENSHOTS) await page.screenshot({ path: join(process.env.ISOCNC_SCREENSHOTS, `page-${name.split(' ').at(-1)}.png`) });
  }
  assert.equal(pictures.size, 4);
});

test('it speaks Italian', shown, async () => {
  await post(wholePath('3', recordingOf(square(200)), 'it'));
  assert.match(await page.locator('#totals').innerText(), /tempo/);
});

test('all can be done by keys', shown, async () => {
  await page.locator('#stage').focus();
  const reached = new Set();
  for (let i = 0; i < 40; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => document.activeElement?.id || document.activeElement?.textContent));
  }
  for (const wanted of ['play', 'scrubber', 'speed', 'help', 'stage', 'mode-tool', 'layer-rapids', 'Iso']) assert.ok(reached.has(wanted), wanted);
  await page.locator('#stage').focus();
  await page.keyboard.press('End');
  const atEnd = (await now()).line;
  await page.keyboard.press('Home');
  assert.ok((await now()).line < atEnd);
});

test('a program that does not move yet shows its tool', shown, async () => {
  await post({ ...wholePath('still', recordingOf('M06 T101001\nM02\n')), program: 'still' });
  const [tip, above] = await page.evaluate(() => [[0, 0, 0], [0, 0, 120]].map((place) => globalThis.isocnc.view.project(place)));
  const { width, height } = await page.evaluate(() => globalThis.isocnc.view.canvas.getBoundingClientRect().toJSON());
  for (const { x, y } of [tip, above]) assert.ok(x > 0 && x < width && y > 0 && y < height, `${x} ${y} in ${width} ${height}`);
  assert.ok(tip.y - above.y > 20, `${tip.y - above.y} pixels`);
});

test('it shows what surrounds a program, and leads to the line of a contact', shown, async () => {
  const { facts, ...streams } = sceneRecording('head');
  const data = Object.fromEntries(Object.entries(streams).map(([name, bytes]) => [name, Buffer.from(bytes).toString('base64')]));
  await post({ ...wholePath('scene', { facts, ...data }), program: 'scene' });
  await post({ type: 'stock', size: null });
  assert.equal(await page.locator('#contact-list button').count(), 2);
  await said();
  await page.locator('#contact-list button').first().click();
  assert.deepEqual(await said(), [{ type: 'picked', line: 3 }]);
  assert.equal(await page.evaluate(() => globalThis.isocnc.player.time), contacts[0].time);
  // The editor's cursor goes to a line: its contact lights up.
  await post({ type: 'lines', first: 7, last: 7 });
  assert.equal(await page.locator('#contact-list [aria-current]').innerText().then((text) => text.split('\n')[0]), contacts[1].code);
  for (const [name, width] of [['vscode-dark', 700], ['vscode-light', 360]]) {
    await page.evaluate((classes) => (document.body.className = classes), name);
    await page.setViewportSize({ width, height: 800 });
    await drawn();
    await drawn();
    if (process.env.ISOCNC_SCREENSHOTS) await page.screenshot({ path: join(process.env.ISOCNC_SCREENSHOTS, `page-scene-${width}.png`) });
    const clock = await page.locator('#clock').boundingBox();
    assert.ok(clock.x + clock.width <= width, `the clock ends at ${clock.x + clock.width} of ${width} pixels`);
  }
  await post({ ...wholePath('bare', recordingOf(square(200))), program: 'bare' });
  assert.equal(await page.locator('#verification').isVisible(), false);
  assert.equal(await page.evaluate(() => globalThis.isocnc.view.sceneModel), null);
});

test('it cuts the stock, leads to the line that has cut it, and hands files to the editor', shown, async () => {
  await page.setViewportSize({ width: 1000, height: 800 });
  const { facts, ...streams } = { ...recordingOfMoves(panel.facts, panel.moves), cuts: panel.cuts };
  const base64 = (bytes) => Buffer.from(bytes).toString('base64');
  const data = Object.fromEntries(Object.entries(streams).map(([name, bytes]) => [name, base64(bytes)]));
  await post({ ...wholePath('cut', { facts, ...data }), program: 'cut' });
  const pocket = () => page.evaluate(() => globalThis.isocnc.view.stockModel.timeline.dexels.tops[80 * 200 + 50]);
  await post({ type: 'pose', line: 4, tip: [90, 20, 8], b: 0, c: 0, seconds: 5 });
  assert.equal(await pocket(), 18_000);
  await post({ type: 'pose', line: 6, tip: [20, 90, 30], b: 0, c: 0, seconds: 8 });
  assert.equal(await pocket(), 8000);
  await page.getByRole('button', { name: 'Top', exact: true }).click();
  await drawn();
  await said();
  await page.locator('#stage').click({ position: await page.evaluate(() => globalThis.isocnc.view.project([80, 85, 8])) });
  assert.deepEqual(await said(), [{ type: 'picked', line: 5 }]);
  if (process.env.ISOCNC_SCREENSHOTS) await page.screenshot({ path: join(process.env.ISOCNC_SCREENSHOTS, 'page-stock.png') });

  for (const [key, name, start] of [['o', 'panel.stl', 'ISOCNC'], ['p', 'panel.png', '\x89PNG']]) {
    await page.locator('#stage').focus();
    await page.keyboard.press(key);
    await page.waitForFunction(() => globalThis.said.some(({ type }) => type === 'save'));
    const [{ content, ...message }] = await page.evaluate(() =>
      globalThis.said.splice(0).map((each) => ({ ...each, content: String.fromCharCode(...each.content.slice(0, 6)) })));
    assert.deepEqual(message, { type: 'save', name });
    assert.ok(content.startsWith(start), content);
  }

  // An edit after which the last moment is missing, and one after which nothing is cut.
  const same = (bytes) => ({ start: bytes.length, removed: 0, data: '' });
  const unchanged = { steps: same(streams.steps), points: same(streams.points), turns: same(streams.turns) };
  const shorter = encoded({ ...panel.stream, moments: panel.stream.moments.slice(0, -1) });
  const moments = () => page.evaluate(() => globalThis.isocnc.view.stockModel?.timeline.momentCount);
  assert.equal(await moments(), 6);
  const patch = { start: shorter.length, removed: panel.cuts.length - shorter.length, data: '' };
  await post({ type: 'path', program: 'cut', resultId: 'less', previousResultId: 'cut', facts, language: 'en', patches: { ...unchanged, cuts: patch } });
  assert.equal(await moments(), 5);
  await post({ type: 'path', program: 'cut', resultId: 'none', previousResultId: 'less', facts: { ...facts, stock: undefined }, language: 'en', patches: unchanged });
  assert.equal(await moments(), undefined);
  assert.equal(await page.locator('#stock').isVisible(), false);
});

test('nothing has gone wrong', shown, () => assert.deepEqual(problems, []));

// The stock in the page of isorun, in a browser: cut up to the moment that is shown, with its colors, sections, places and files.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { openBrowser } from './browser.mjs';
import { freshPage, recordingOf } from './run.mjs';
import { program, sceneRecording } from './scene.mjs';
import { encoded, panel, stockFacts } from './stock.mjs';

const { open, close, drawn, keep, problems, project, currentLine, colorIn } = await openBrowser();

/** What is drawn alone, without what lies above it; base64. */
const picture = (of) =>
  of.evaluate(async () => {
    const bytes = new Uint8Array(await (await globalThis.isocnc.view.picture()).arrayBuffer());
    return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
  });
const recording = { ...recordingOf(panel.facts, panel.moves), cuts: panel.cuts };
const files = {};
let page;
before(async () => {
  files.panel = await freshPage('panel', recording, panel.program);
  page = await open(files.panel);
});
after(close);

/** When all of the stock is drawn. */
const settled = async (of) => {
  await drawn(of);
  await of.waitForFunction(() => !globalThis.isocnc.view.stockModel.lastUpdate.isMore);
  await drawn(of);
};
const seek = async (of, time) => {
  await of.evaluate((to) => globalThis.isocnc.player.seek(to), time);
  await settled(of);
};
/** The height of the stock's top where a dexel is, in mm. */
const topAt = (of, x, y) => of.evaluate((dexel) => globalThis.isocnc.view.stockModel.timeline.dexels.tops[dexel] / 1000, Math.floor(y) * 200 + Math.floor(x));
const clickAt = async (of, at) => of.locator('#stage').click({ position: await project(of, at) });

/** What is drawn where a place of the machine is: red, green, blue. */
async function colorAt(of, place) {
  await settled(of);
  return colorIn(of, await picture(of), place);
}

test('the stock is cut up to the moment, forwards and back', async () => {
  assert.equal(await page.locator('#layer-stock').isChecked(), true);
  await settled(page);
  assert.equal(await topAt(page, 50, 20), 18);
  const blank = await picture(page);
  for (const [time, pocket, corner] of [[4, 18, 14], [8, 8, 14], [3.9, 18, 18], [17, 8, 14], [0, 18, 18]]) {
    await seek(page, time);
    assert.deepEqual([await topAt(page, 50, 80), await topAt(page, 50, 20)], [pocket, corner], `at ${time} s`);
  }
  assert.ok((await picture(page)) === blank, 'it looks otherwise than before');
  // Step by step, by keys.
  await page.locator('#program').focus();
  await page.keyboard.press('Home');
  for (let i = 0; i < 2; ++i) await page.keyboard.press('ArrowDown');
  assert.equal(await topAt(page, 50, 20), 14);
  await page.keyboard.press('ArrowUp');
  assert.equal(await topAt(page, 50, 20), 18);
});

test('it is cut while the time runs', async () => {
  await page.keyboard.press('Home');
  await page.locator('#speed').selectOption('20');
  await page.locator('#play').click();
  await page.waitForFunction(() => globalThis.isocnc.player.time > 8);
  await page.evaluate(() => (globalThis.isocnc.player.isPlaying = false));
  assert.equal(await topAt(page, 50, 80), 8);
});

test('the layer and its key leave it out', async () => {
  await seek(page, 17);
  const whole = await picture(page);
  await page.locator('#stage').focus();
  await page.keyboard.press('s');
  await drawn(page);
  assert.equal(await page.locator('#layer-stock').isChecked(), false);
  assert.ok((await picture(page)) !== whole);
  await page.keyboard.press('s');
  assert.equal(await page.locator('#layer-stock').isChecked(), true);
});

test('the path can be left out, and a click then finds the stock beneath it', async () => {
  await page.getByRole('button', { name: 'Top' }).click();
  await seek(page, 17);
  const whole = await picture(page);
  await page.locator('#stage').focus();
  await page.keyboard.press('l');
  assert.equal(await page.locator('#layer-path').isChecked(), false);
  assert.ok((await picture(page)) !== whole);
  assert.equal(await page.evaluate(() => globalThis.isocnc.view.pick(...Object.values(globalThis.isocnc.view.project([50, 20, 14])))), null);
  await clickAt(page, [50, 20, 14]);
  assert.equal(await currentLine(page), 4);
  await page.keyboard.press('End');
  await page.keyboard.press('l');
  assert.ok((await picture(page)) === whole);
  await page.getByRole('button', { name: 'Iso' }).click();
});

test('removed and remaining volume stand beside the time', async () => {
  assert.match(await page.locator('#totals').textContent(), /time0:17\.0.*removed99\.4 cm³.*remains333 cm³/);
});

test('each mode has its own colors and legend', async () => {
  const pictures = new Set();
  const legends = [];
  for (const mode of ['tool', 'operation', 'deviation', 'depth']) {
    await page.locator(`#stock-mode-${mode}`).check({ force: true });
    await settled(page);
    pictures.add(await picture(page));
    legends.push(await page.locator('#stock-legend').textContent());
    await keep(page, `stock-${mode}`);
  }
  // Each of its tools has one operation, the first and the second.
  assert.equal(pictures.size, 3);
  assert.deepEqual(legends, [
    'T101001 millT102002 ballnot cut',
    'lines 2–11: T101001 milllines 13–16: T102002 ballnot cut',
    'more than 0.05 mm leftright, within 0.05 mmmore than 0.05 mm too deepnot cut',
    '010.0 mmnot cut',
  ]);
  await page.locator('#stage').focus();
  await page.keyboard.press('Shift+B');
  assert.equal(await page.locator('#stock-mode-deviation').isChecked(), true);
  await page.keyboard.press('b');
  await page.keyboard.press('b');
  assert.equal(await page.locator('#stock-mode-tool').isChecked(), true);
});

test('what is too deep is red, and what is right green', async () => {
  await page.locator('#stock-mode-deviation').check({ force: true });
  await page.getByRole('button', { name: 'Top' }).click();
  const [gouged, within, left] = [await colorAt(page, [45, 45, 8]), await colorAt(page, [80, 85, 8]), await colorAt(page, [40, 25, 14])];
  assert.ok(gouged[0] > 1.5 * gouged[1], `${gouged}`);
  assert.ok(within[1] > 1.1 * within[0], `${within}`);
  assert.ok(left[2] > 1.5 * left[0], `${left}`);
  await page.locator('#stock-mode-tool').check({ force: true });
});

test('a click on the surface leads to the line that has cut it, and tells what it has removed', async () => {
  await page.getByRole('button', { name: 'Top' }).click();
  await seek(page, 17);
  for (const [line, place, removes] of [
    [6, [70, 80, 8], 'removes 60.2 cm³, 10.00 mm deep, width 70.00 mm'],
    [4, [40, 26, 14], 'removes 4.5 cm³, 4.00 mm deep, width 16.00 mm'],
    [14, [160, 70, 14], 'removes 4.5 cm³, 8.00 mm deep, width 36.00 mm'],
  ]) {
    await clickAt(page, place);
    assert.equal(await currentLine(page), line);
    assert.equal(await page.locator('#removes').textContent(), removes);
    await seek(page, 17);
  }
  // Nothing has cut the blank.
  await clickAt(page, [105, 112, 18]);
  assert.equal(await currentLine(page), 16);
});

test('a section shows the inside, and moves by slider and keys', async () => {
  await page.getByRole('button', { name: 'Iso' }).click();
  await seek(page, 17);
  const whole = await picture(page);
  await page.locator('#stage').focus();
  await page.keyboard.press('y');
  await settled(page);
  assert.equal(await page.locator('#section-value').textContent(), 'Y 60.000');
  await keep(page, 'stock-section');
  const first = await picture(page);
  assert.ok(first !== whole);
  await page.keyboard.press('PageUp');
  await page.keyboard.press('Shift+PageUp');
  assert.equal(await page.locator('#section-value').textContent(), 'Y 71.000');
  await settled(page);
  assert.ok((await picture(page)) !== first);
  await page.locator('#section-place').focus();
  await page.keyboard.press('ArrowLeft');
  assert.equal(await page.locator('#section-value').textContent(), 'Y 70.000');
  await page.keyboard.press('r');
  await settled(page);
  await keep(page, 'stock-section-other');
  await page.keyboard.press('z');
  assert.equal(await page.locator('#section-value').textContent(), 'Z 9.000');
  await settled(page);
  await keep(page, 'stock-section-z');
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('#section-none').isChecked(), true);
  assert.equal(await page.locator('#section-row').isVisible(), false);
  await settled(page);
  assert.ok((await picture(page)) === whole, 'it looks otherwise than before');
});

test('measures from the floor of the pocket to the top', async () => {
  await page.getByRole('button', { name: 'Top' }).click();
  await page.keyboard.press('m');
  await clickAt(page, [70.2, 80.3, 8]);
  await clickAt(page, [105.1, 60.4, 18]);
  const text = await page.locator('#measurement').textContent();
  assert.match(text, /1: on the stock, cut by line 6.*2: on the stock/);
  // From the middle of a dexel to that of another.
  assert.match(text, /dX35\.000.*dY-20\.000.*depth10\.000/);
  await page.keyboard.press('Escape');
});

test('the stock and the picture can be saved', async () => {
  await page.getByRole('button', { name: 'Iso' }).click();
  const saved = async (act) => {
    const [download] = await Promise.all([page.waitForEvent('download'), act()]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };
  const stl = await saved(() => page.getByRole('button', { name: 'STL' }).or(page.locator('#save-stock')).first().click());
  assert.equal(stl.name, 'panel.stl');
  assert.equal(stl.bytes.length, 84 + 50 * stl.bytes.readUInt32LE(80));
  await page.locator('#stage').focus();
  const png = await saved(() => page.keyboard.press('p'));
  assert.equal(png.name, 'panel.png');
  assert.equal(png.bytes.subarray(1, 4).toString(), 'PNG');
  assert.ok(png.bytes.length > 10_000, `${png.bytes.length} bytes`);
});

test('the debugger poses the machine, and the stock with it', async () => {
  await page.evaluate(() => {
    const { player, path } = globalThis.isocnc;
    player.seek(path.timeNear(4, [82, 28, 8], 0));
  });
  await settled(page);
  assert.equal(await topAt(page, 50, 20), 14);
});

test('all is named for those who hear it, and in the help', async () => {
  for (const [role, name] of [['radiogroup', 'Color the stock by'], ['radiogroup', 'Section'], ['button', /Save the picture/], ['button', /Save the stock/]])
    assert.equal(await page.getByRole(role, { name }).count(), 1, String(name));
  await page.keyboard.press('?');
  const keys = await page.locator('#keys').textContent();
  for (const text of ['section through the stock', 'move the section', 'next color of the stock', 'the stock as STL']) assert.ok(keys.includes(text), text);
  await page.keyboard.press('Escape');
});

test('stock on a table rests with the path, and stock beside it turns with the machine', async () => {
  const { facts, ...streams } = sceneRecording('table');
  for (const onTable of [true, false]) {
    const stock = stockFacts(20, 20, { onTable });
    const cuts = encoded({ blank: [[400, [[10_000, 0]]]], moments: [] });
    const turned = await open(await freshPage(`table ${onTable}`, { ...streams, facts: { ...facts, stock }, cuts }, program));
    // B is at 90 degrees: as seen from the table, what rests is turned about the B axis at Z-50.
    await turned.evaluate(() => globalThis.isocnc.player.seek(4));
    const { min, max } = await turned.evaluate(() => globalThis.isocnc.view.stockModel.bounds());
    const corners = [min.x, min.y, min.z, max.x, max.y, max.z].map(Math.round);
    assert.deepEqual(corners, onTable ? [0, 0, 0, 20, 20, 10] : [50, 0, -70, 60, 20, -50]);
    // The blank of the scene makes room.
    assert.equal(await turned.evaluate(() => globalThis.isocnc.view.sceneModel.parts.find(({ body }) => body.role === 'stock').mesh.visible), false);
    await turned.context().close();
  }
});

test('in the dark, in Italian', async () => {
  const italian = { ...recording, facts: { ...recording.facts, language: 'it' } };
  const dark = await open(await freshPage('pannello', italian, panel.program), { colorScheme: 'dark' });
  await seek(dark, 17);
  for (const mode of ['tool', 'deviation', 'depth']) {
    await dark.locator(`#stock-mode-${mode}`).check({ force: true });
    await settled(dark);
    await keep(dark, `stock-dark-${mode}`);
  }
  assert.match(await dark.locator('#stock-legend').textContent(), /non lavorato/);
  assert.match(await dark.locator('#totals').textContent(), /asportato99\.4 cm³/);
  await dark.keyboard.press('x');
  await settled(dark);
  await keep(dark, 'stock-dark-section');
  await dark.context().close();
});

test('a recording without a stock, and one whose stock is damaged, show the path', async () => {
  const old = await open(await freshPage('old', { ...recording, cuts: undefined, facts: { ...panel.facts, stock: undefined } }, panel.program));
  assert.equal(await old.evaluate(() => globalThis.isocnc.view.stockModel), null);
  assert.equal(await old.locator('#stock').isVisible(), false);
  assert.equal(await old.locator('#save-picture').isVisible(), true);
  assert.equal(await old.locator('#save-stock').isVisible(), false);
  await old.context().close();
  assert.deepEqual(problems, []);
  const broken = await open(await freshPage('broken', { ...recording, cuts: panel.cuts.slice(0, 100) }, panel.program));
  assert.equal(await broken.evaluate(() => globalThis.isocnc.view.stockModel), null);
  assert.match(problems.join(), /the stream of the stock is damaged/);
  problems.length = 0;
  await broken.context().close();
});

test('nothing has gone wrong', () => assert.deepEqual(problems, []));

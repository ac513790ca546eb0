// The page of isodiff --format html in a browser, from a file, without any network. With ISOCNC_SCREENSHOTS=docs/images it takes the picture of the
// documentation.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { openBrowser } from './browser.mjs';
import { folder, root, write } from './run.mjs';

const isodiff = process.env.ISODIFF ?? join(dirname(process.env.ISORUN ?? join(root, 'build/release/bin/isorun')), 'isodiff');
const { open, close, drawn, keep, picture, problems, requests } = await openBrowser();

/** The page of two programs. */
function pageOf(old, now, status, ...options) {
  const page = join(folder, `${process.hrtime.bigint()}.html`);
  const result = spawnSync(isodiff, ['--no-config', '--format', 'html', '--output', page, ...options, old, now], { encoding: 'utf8' });
  assert.equal(result.status, status, result.stderr);
  return page;
}

const tray = write(
  'tray.iso',
  `; tray
M06 T101001
S12000 M03
G00 X20 Y20 Z40
G01 Z-5 F2000
X120
Y80
X20
Y20
G00 Z40
; second pocket
G00 X150 Y20
G01 Z-5
X230
G03 X250 Y40 R20
G01 Y80
X150
Y20
G00 Z40
; holes
M06 T102002
S8000 M03
G00 X40 Y110 Z20
G01 Z-12 F600
G00 Z20
G00 X100 Y110
G01 Z-12
G00 Z20
G00 X160 Y110
G01 Z-12
G00 Z20
M02
`,
);
/** With numbers and G91: the first pocket is 10 mm longer, the second one slower, a hole less, and a groove at the end. */
const revised = write(
  'tray-b.iso',
  `; tray, revised
N10 M06 T101001
N20 S12000 M03
N30 G00 X20 Y20 Z40
N40 G01 Z-5 F2000
N50 G91
N60 X100
N70 Y70
N80 X-100
N90 Y-70
N100 G90
N110 G00 Z40
; second pocket
N120 G00 X150 Y20
N130 G01 Z-5
N140 X230 F1200
N150 G03 X250 Y40 R20
N160 G01 Y80
N170 X150
N180 Y20
N190 G00 Z40
; holes
N200 M06 T102002
N210 S8000 M03
N220 G00 X40 Y110 Z20
N230 G01 Z-12 F600
N240 G00 Z20
N250 G00 X160 Y110
N260 G01 Z-12
N270 G00 Z20
; groove <b>
N280 G00 X200 Y100
N290 G01 Z-2
N300 X240 Y120
N310 G00 Z20
N320 M02
`,
);

let page;
before(async () => {
  page = await open(pageOf(tray, revised, 1), { viewport: { width: 1320, height: 760 } });
});
after(close);

const changes = () => page.locator('#change-list .change');
const tips = () =>
  page.evaluate(() => {
    const { comparison, player } = globalThis.isocnc;
    const tip = (side) => comparison.paths[side].at(comparison.clock.time(side, player.moment)).tip;
    return { old: tip('old'), new: tip('new') };
  });
const currentLines = async () => {
  await drawn(page);
  return page.locator('#program .cell.current').evaluateAll((cells) => cells.map((cell) => `${cell.dataset.side} ${cell.querySelector('.number').textContent}`).sort().reverse());
};
const near = (one, other, tolerance = 0.1) => assert.ok(Math.hypot(...one.map((value, i) => value - other[i])) < tolerance, `${one} is not ${other}`);

test('shows both programs aligned, and what differs', async () => {
  assert.equal(await page.title(), 'tray.iso → tray-b.iso');
  assert.equal(await page.locator('#changes-title').textContent(), '4 differences');
  assert.deepEqual(await changes().locator('.message').allTextContents(), ['moved by Y10', 'F1200 instead of F2000', 'removed: 3 motions', 'added: 4 motions']);
  const rows = await page.locator('#program .pair').evaluateAll((pairs) => pairs.map((pair) => [...pair.children].map((cell) => cell.querySelector('.text')?.textContent ?? '')));
  assert.deepEqual(rows.slice(3, 11), [
    ['G00 X20 Y20 Z40', 'N30 G00 X20 Y20 Z40'],
    ['G01 Z-5 F2000', 'N40 G01 Z-5 F2000'],
    ['', 'N50 G91'],
    ['X120', 'N60 X100'],
    ['Y80', 'N70 Y70'],
    ['X20', 'N80 X-100'],
    ['Y20', 'N90 Y-70'],
    ['', 'N100 G90'],
  ]);
  assert.deepEqual(rows[0], ['; tray', '; tray, revised']);
  // Comments are text.
  await page.locator('#program').evaluate((list) => (list.scrollTop = list.scrollHeight));
  await drawn(page);
  assert.equal(await page.locator('#program .cell', { hasText: 'groove' }).locator('.text').textContent(), '; groove <b>');
  await page.locator('#program').evaluate((list) => (list.scrollTop = 0));
  await drawn(page);
  const marked = await page.locator('#program .cell[data-mark="moved"] .text').allTextContents();
  assert.deepEqual(marked, ['Y80', 'N70 Y70', 'X20', 'N80 X-100']);
  // Who sees no colors sees signs.
  assert.deepEqual(await page.locator('#program .cell[data-mark="moved"] .sign').allTextContents(), ['↔', '↔', '↔', '↔']);
  assert.match(await page.locator('#legend').textContent(), /the same.*moved.*added.*removed.*changed.*dotted: the old path/);
  assert.match(await page.locator('#totals').textContent(), /moves25 \(was 24\)/);
});

test('a change in the list is shown in the picture and in both programs', async () => {
  const before = await picture(page);
  await changes().nth(0).click();
  assert.deepEqual(await currentLines(), ['old 7', 'new 8']);
  near((await tips()).old, [120, 80, -5]);
  near((await tips()).new, [120, 90, -5]);
  assert.equal(await changes().nth(0).getAttribute('aria-selected'), 'true');
  assert.notEqual(await picture(page), before);
  // Once more: from near.
  const zoom = () => page.evaluate(() => globalThis.isocnc.view.camera.zoom);
  const far = await zoom();
  await changes().nth(0).click();
  assert.ok((await zoom()) > far);
  await page.getByRole('button', { name: 'Fit' }).click();
});

test('keys and buttons go from difference to difference', async () => {
  await page.evaluate(() => document.activeElement?.blur());
  await page.keyboard.press('Home');
  const lines = [];
  for (const go of [() => page.keyboard.press('d'), () => page.locator('#change-next').click(), () => page.keyboard.press('d'), () => page.keyboard.press('Shift+D'), () => page.locator('#change-previous').click()]) {
    await go();
    lines.push((await currentLines()).join(', '));
  }
  assert.deepEqual(lines, ['old 7, new 8', 'old 14, new 16', 'old 26, new 27', 'old 14, new 16', 'old 7, new 8']);
  // From a moment: the next one after it.
  await page.locator('#program .cell[data-side="old"]', { hasText: 'G03 X250' }).click();
  await page.keyboard.press('d');
  await drawn(page);
  assert.equal(await changes().nth(2).getAttribute('aria-selected'), 'true');
});

test('a click on a line of either program brings both tools there', async () => {
  await page.locator('#program .cell[data-side="old"]', { hasText: /G00 X100 Y110/ }).click();
  near((await tips()).old, [100, 110, 20]);
  near((await tips()).new, [40, 110, 20]); // It waits where the old one goes on alone.
  await page.locator('#program .cell[data-side="new"]', { hasText: 'N150 G03' }).click();
  near((await tips()).old, [250, 40, -5]);
  near((await tips()).new, [250, 40, -5]);
  assert.deepEqual(await currentLines(), ['old 15', 'new 17']);
  // The arrows go on by rows.
  await page.locator('#program').press('ArrowDown');
  assert.deepEqual(await currentLines(), ['old 16', 'new 18']);
});

test('one clock leads both tools through the same cuts at the same moment', async () => {
  const { seconds, places } = await page.evaluate(() => {
    const { comparison, player } = globalThis.isocnc;
    const places = [];
    for (let line = 13; line <= 17; ++line) {
      const path = comparison.paths.new;
      const { end } = path.stepsOf(line + 2);
      player.seek(path.endOf(end - 1) - 0.05);
      const tip = (side) => comparison.paths[side].at(comparison.clock.time(side, player.moment)).tip;
      places.push([tip('old'), tip('new')]);
    }
    return { seconds: player.seconds, places };
  });
  for (const [old, now] of places) near(old, now, 0.2);
  assert.equal(Number(await page.locator('#scrubber').getAttribute('max')), seconds);
  assert.match(await page.locator('#clock').textContent(), /^Old 0:\d\d\.\d \/ 0:53\.7 · New 0:\d\d\.\d \/ 1:04\.0$/);
  // It plays to the end of both.
  await page.locator('#speed').selectOption('1000');
  await page.keyboard.press('Home');
  await page.locator('#play').click();
  await page.waitForFunction(() => !globalThis.isocnc.player.isPlaying);
  const ended = await page.evaluate(() => {
    const { comparison, player } = globalThis.isocnc;
    return { moment: player.moment, old: comparison.clock.time('old', player.moment) - comparison.paths.old.seconds, new: player.time - comparison.paths.new.seconds };
  });
  assert.equal(ended.moment, seconds);
  assert.ok(Math.abs(ended.old) < 1e-6 && Math.abs(ended.new) < 1e-6);
});

test('the arrow keys go through the moves of both programs', async () => {
  await page.locator('#program .cell[data-side="new"]', { hasText: 'N240 G00 Z20' }).click();
  await page.evaluate(() => document.activeElement?.blur());
  const lines = [];
  for (let i = 0; i < 4; ++i) {
    await page.keyboard.press('ArrowRight');
    lines.push((await currentLines()).join(', '));
  }
  assert.deepEqual(lines, ['old 26, new 27', 'old 27, new 27', 'old 28, new 27', 'old 29, new 28']);
});

test('a click on the old path shows its line', async () => {
  await page.getByRole('button', { name: 'Top' }).click();
  await drawn(page);
  const at = await page.evaluate(() => globalThis.isocnc.view.project([70, 80, -5]));
  await page.locator('#stage').click({ position: at });
  near((await tips()).old, [70, 80, -5], 3);
  assert.deepEqual(await currentLines(), ['old 8', 'new 9']);
});

test('the slider blends old and new', async () => {
  const pictures = new Set();
  for (const part of ['0', '0.5', '1']) {
    await page.locator('#blend-part').fill(part);
    await drawn(page);
    pictures.add(await picture(page));
  }
  assert.equal(pictures.size, 3);
  // W: the old one alone, both, the new one alone.
  await page.evaluate(() => document.activeElement?.blur());
  const values = [];
  for (let i = 0; i < 3; ++i) {
    await page.keyboard.press('w');
    values.push(await page.locator('#blend-part').inputValue());
  }
  assert.deepEqual(values, ['0', '0.5', '1']);
  await page.keyboard.press('Shift+W');
});

test('speaks Italian, in the dark, and in a narrow window', async () => {
  await page.locator('#language').click();
  await drawn(page);
  assert.equal(await page.locator('#changes-title').textContent(), '4 differenze');
  assert.equal(await changes().nth(0).locator('.message').textContent(), 'spostato di Y10');
  assert.match(await page.locator('#program-heads').textContent(), /^Vecchiotray\.iso/);
  assert.equal(await page.locator('#program .cell[data-mark="moved"]').first().getAttribute('title'), 'spostato');
  await page.locator('#theme').click();
  await drawn(page);
  await page.setViewportSize({ width: 480, height: 800 });
  await drawn(page);
  const sizes = await page.evaluate(() => [document.documentElement.scrollWidth, document.querySelector('#stage').clientHeight, document.querySelector('#program').clientHeight]);
  assert.ok(sizes[0] <= 480 && sizes[1] > 150 && sizes[2] > 80, String(sizes));
  await page.setViewportSize({ width: 1320, height: 760 });
  await page.locator('#theme').click();
  await page.locator('#language').click();
});

test('where nothing differs, it says so', async () => {
  const same = await open(pageOf(tray, tray, 0));
  assert.equal(await same.locator('#changes-title').textContent(), 'No difference in what the machine does');
  assert.equal(await same.locator('#change-next').isVisible(), false);
  assert.equal(await same.locator('#program .cell[data-mark]').count(), 0);
  await same.keyboard.press('d');
  await same.context().close();
});

test('programs that do nothing, or end in an error, have a page', async () => {
  const empty = write('empty.iso', '');
  const broken = write('broken.iso', 'M06 T101001\nG00 X10\nG01 X20\n');
  for (const [old, now, status] of [[empty, empty, 0], [empty, tray, 1], [tray, empty, 1], [tray, broken, 1]]) {
    const other = await open(pageOf(old, now, status));
    await other.keyboard.press('d');
    await other.keyboard.press('End');
    await other.keyboard.press('ArrowRight');
    await other.context().close();
  }
});

test('100,000 lines open, scroll and play', async () => {
  const lines = (edit) => {
    const text = ['M06 T101001', 'S12000 M03', 'G01 X0 Y0 F5000'];
    for (let i = 3; i < 99_999; ++i) text.push(edit(i) ?? `X${((i * 37) % 1000) / 10} Y${(i % 777) / 10}`);
    return `${text.join('\n')}\nM02\n`;
  };
  const old = write('long.iso', lines(() => undefined));
  const now = write('long-b.iso', lines((i) => (i % 20_000 === 500 ? `X50 Y${i / 5000}` : undefined)));
  const long = await open(pageOf(old, now, 1));
  assert.equal(await long.locator('#changes-title').textContent(), '5 differences');
  assert.ok((await long.locator('#program .pair').count()) < 100);
  await long.locator('#change-list .change').nth(4).click();
  await drawn(long);
  assert.deepEqual(await long.locator('#program .cell.current .number').allTextContents(), ['80501', '80501']);
  for (let i = 1; i <= 3; ++i) {
    const step = await long.evaluate((part) => {
      const { comparison, player } = globalThis.isocnc;
      player.seekMoment(part * player.seconds);
      return comparison.paths.old.at(comparison.clock.time('old', player.moment)).step - player.step;
    }, i / 4);
    await drawn(long);
    assert.equal(step, 0);
  }
  await long.context().close();
});

test('the picture of the documentation', async () => {
  await page.getByRole('button', { name: 'Iso' }).click();
  await changes().nth(0).click();
  await page.locator('#speed').selectOption('1');
  await page.evaluate(() => globalThis.isocnc.view.fit());
  await drawn(page);
  await keep(page, 'isodiff');
});

test('asks for nothing from outside, and nothing goes wrong', () => {
  assert.deepEqual(problems, []);
  assert.ok(requests.every((url) => url.startsWith('file:') || url.startsWith('data:') || url.startsWith('blob:')), String(requests));
  assert.ok(readFileSync(pageOf(tray, revised, 1)).length < 1_200_000);
});

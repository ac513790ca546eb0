// The page of isorun --plot FILE.html in a browser, from a file, without any network.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openBrowser } from './browser.mjs';
import { pageOf, root, run, write } from './run.mjs';

const { open, close, drawn, keep, picture, problems, requests } = await openBrowser();

/** A square with two tools and a corner that is round; its comments would like to be more than text. */
const square = write(
  'square </script><script>alert(1)</script>.iso'.replaceAll('/', '∕'),
  `; </script><script>window.hacked = 1</script><img src=x onerror="window.hacked = 1"><!--
M06 T101001
S12000 M03
G92 X100 Y100 Z0
G00 X0 Y0 Z20
G01 Z0 F1200
X200
Y80
G03 X180 Y100 R20
G01 X0 F4000
Y0
G00 Z20
M06 T102002
G29 X0 Y0 Z0 B90
G27
G00 X100 Y50
G01 Z-5 F600
G00 Z20
M02 ; \u2028 \xe0\xe8 </style>
`,
);
const machine = write(
  'machine.json',
  `{"machine": {"axes": {"X": {"min": -50, "max": 900}, "Y": {"min": -50, "max": 600}, "Z": {"min": -250, "max": 300}},
    "tools": [{"head": 1, "holder": 1, "tool": 1, "name": "fresa </script> D16", "length": 90, "radius": 8},
              {"head": 1, "holder": 2, "tool": 2, "name": "punta", "length": 110, "radius": 3}]}}`,
);

/** What the machine has of the tool. */
const tip = (page) => page.evaluate(() => globalThis.isocnc.path.at(globalThis.isocnc.player.time).tip);

const currentLine = async (page) => {
  await drawn(page);
  return Number(await page.locator('#program .line.current .number').textContent());
};

let file;
let page;
before(async () => {
  file = pageOf(square, '--machine', machine);
  page = await open(file);
});
after(close);

test('shows the program and its moves', async () => {
  assert.equal(await page.evaluate(() => globalThis.isocnc.view !== null), true);
  assert.match(await page.locator('#totals').textContent(), /moves11cut/);
  assert.equal(await page.locator('#program .line').count(), 19);
  assert.match(await page.locator('#outcome').textContent(), /ran to M02/);
  assert.match(await page.locator('#legend').textContent(), /T101001 fresa <\/script> D16.*T102002 punta/);
  await keep(page, 'light');
});

test('a hostile program is text', async () => {
  assert.equal(await page.evaluate(() => globalThis.hacked), undefined);
  const first = await page.locator('#program .line').first().textContent();
  assert.ok(first.includes('; </script><script>window.hacked = 1</script><img src=x onerror="window.hacked = 1"><!--'));
  assert.match(await page.title(), /<script>alert\(1\)/);
  assert.equal(await page.locator('img').count(), 0);
});

test('nothing may run in the page but its own script', async () => {
  const added = await open(file);
  const before = problems.length;
  await added.evaluate(() => {
    const script = document.createElement('script');
    try {
      script.textContent = 'window.hacked = 1';
      document.body.append(script);
    } catch {
      // Refused at once.
    }
  });
  assert.equal(await added.evaluate(() => globalThis.hacked), undefined);
  assert.ok(problems.length > before);
  problems.length = before;
  await added.context().close();
});

test('a click on a move shows its line and brings the tool there', async () => {
  await page.getByRole('button', { name: 'Top' }).click();
  await drawn(page);
  for (const [line, place] of [
    [7, [200, 100, 0]],
    [8, [300, 140, 0]],
    [11, [100, 150, 0]],
  ]) {
    const at = await page.evaluate((where) => globalThis.isocnc.view.project(where), place);
    await page.locator('#stage').click({ position: at });
    assert.equal(await currentLine(page), line);
    const found = await tip(page);
    assert.ok(Math.hypot(...found.map((value, i) => value - place[i])) < 3, `${found}`);
  }
  await keep(page, 'top');
});

test('scrubbing moves the tool', async () => {
  const places = [];
  for (const part of [0.2, 0.5, 0.95]) {
    await page.locator('#scrubber').evaluate((scrubber, to) => {
      scrubber.value = String(Number(scrubber.max) * to);
      scrubber.dispatchEvent(new Event('input'));
    }, part);
    const [x] = await tip(page);
    assert.ok((await page.locator('#readout').textContent()).includes(x.toFixed(3)));
    places.push(`${await tip(page)} ${await currentLine(page)} ${await page.locator('#clock').textContent()}`);
  }
  assert.equal(new Set(places).size, 3);
});

test('a click on a line brings the tool to its end', async () => {
  await page.locator('#program .line').nth(7).click();
  assert.deepEqual(await tip(page).then((place) => place.map(Math.round)), [300, 180, 0]);
  assert.equal(await currentLine(page), 8);
});

test('each mode has its own colors and legend', async () => {
  await page.getByRole('button', { name: 'Iso' }).click();
  const pictures = new Set();
  const legends = new Set();
  for (const mode of ['Tool', 'Feed', 'Kind', 'Time']) {
    await page.getByRole('radio', { name: mode }).check({ force: true });
    await drawn(page);
    pictures.add(await picture(page));
    legends.add(await page.locator('#legend').innerHTML());
    await keep(page, `mode-${mode}`);
  }
  assert.equal(pictures.size, 4);
  assert.equal(legends.size, 4);
});

test('layers can be left out', async () => {
  for (const layer of ['rapids', 'tool', 'frames', 'grid']) {
    await page.getByRole('button', { name: 'Iso' }).click();
    await drawn(page);
    const before = await picture(page);
    await page.locator(`#layer-${layer}`).uncheck();
    await drawn(page);
    assert.notEqual(await picture(page), before, layer);
    await page.locator(`#layer-${layer}`).check();
  }
  await page.keyboard.press('Shift+F');
  await drawn(page);
  const withTravel = await picture(page);
  await page.locator('#layer-travel').uncheck();
  await drawn(page);
  assert.notEqual(await picture(page), withTravel);
  await page.locator('#layer-travel').check();
});

test('works by keys', async () => {
  await page.locator('#program').focus();
  await page.keyboard.press('Home');
  await page.keyboard.press('ArrowDown');
  const line = await currentLine(page);
  await page.keyboard.press('ArrowDown');
  assert.ok((await currentLine(page)) > line);
  await page.keyboard.press('End');
  assert.equal(await page.locator('#clock').textContent().then((text) => new Set(text.split(' / ')).size), 1);
  await page.keyboard.press('ArrowLeft');
  assert.equal(await page.locator('#clock').textContent().then((text) => new Set(text.split(' / ')).size), 2);
  await page.locator('#stage').focus();
  const before = await picture(page);
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('+');
  await drawn(page);
  assert.notEqual(await picture(page), before);
  await page.keyboard.press('v');
  assert.equal(await page.locator('#mode-feed').isChecked(), true);
  await page.keyboard.press('?');
  assert.equal(await page.locator('#keys').isVisible(), true);
  await keep(page, 'keys');
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('#keys').isVisible(), false);
});

test('plays in time, and pauses', async () => {
  await page.keyboard.press('Home');
  await page.locator('#speed').selectOption('5');
  await page.locator('#stage').focus();
  await page.keyboard.press('Space');
  await page.waitForFunction(() => globalThis.isocnc.player.time > 1);
  await page.keyboard.press('Space');
  const time = await page.evaluate(() => globalThis.isocnc.player.time);
  await drawn(page);
  assert.equal(await page.evaluate(() => globalThis.isocnc.player.time), time);
  assert.ok(time < (await page.evaluate(() => globalThis.isocnc.path.seconds)));
});

test('speaks Italian, and is dark where that is preferred', async () => {
  const dark = await open(pageOf(square, '--lang', 'it', '--machine', machine), {
    colorScheme: 'dark',
    reducedMotion: 'reduce',
  });
  assert.match(await dark.locator('#outcome').textContent(), /eseguito fino a M02/);
  assert.equal(await dark.evaluate(() => document.documentElement.dataset.theme), 'dark');
  await dark.locator('#program .line').nth(8).click();
  await drawn(dark);
  await keep(dark, 'dark');
  await dark.locator('#speed').selectOption('0.1');
  await dark.locator('#play').click();
  // At the end of the next move, which takes seconds at this speed.
  await dark.locator('#readout', { hasText: /X\s+100\.0\d\d\s*Y\s+(199\.9|200\.0)/ }).waitFor();
  await dark.locator('#play').click();
  await dark.locator('#language').click();
  assert.match(await dark.locator('#outcome').textContent(), /ran to M02/);
  await dark.context().close();
});

test('shows five axes, and what stops at an error', async () => {
  const five = await open(pageOf(join(root, 'examples/five-axis.iso')));
  await five.locator('#program .line', { hasText: 'X402.5 Y215' }).click();
  assert.match(await five.locator('#readout').textContent(), /B\s+70\.000\s+C\s+3\.750/);
  await drawn(five);
  await keep(five, 'five-axis');
  await five.context().close();
  const out = join(write('stopped.html', ''));
  assert.equal(run('--plot', out, '--no-config', write('stopped.iso', 'M06 T101001\nG00 X5\nG01\nM02\n')).status, 1);
  const stopped = await open(out);
  assert.match(await stopped.locator('#outcome').textContent(), /line 3/);
  await stopped.context().close();
});

test('nothing but the files has been asked for, and nothing has gone wrong', () => {
  assert.deepEqual(requests.filter((url) => !url.startsWith('file:') && !url.startsWith('blob:')), []);
  assert.deepEqual(problems, []);
});

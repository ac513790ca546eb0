// What surrounds a program, in a browser: bodies that move with the machine, contacts, measuring and hiding.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { openBrowser } from './browser.mjs';
import { pageWith } from './run.mjs';
import { certificate, contacts, program, sceneRecording } from './scene.mjs';

const { open, close, drawn, keep, picture, problems, project, currentLine, colorIn } = await openBrowser();

const files = {};
const pages = {};
before(async () => {
  for (const machine of ['threeAxis', 'head', 'table']) files[machine] = pageWith(sceneRecording(machine), program);
  files.bare = pageWith(sceneRecording('head', false), program);
  for (const machine of ['head', 'table']) pages[machine] = await open(files[machine]);
});
after(close);

const seek = (page, time) => page.evaluate((to) => globalThis.isocnc.player.seek(to), time);
const bounds = (page, name) => page.evaluate((of) => globalThis.isocnc.view.sceneModel.boundsOf(of), name);

/** What is drawn where a place of the machine is: red, green, blue. */
async function colorAt(page, place) {
  await drawn(page);
  return colorIn(page, await picture(page), place);
}

async function isAt(page, name, min, max) {
  const found = await bounds(page, name);
  const off = Math.max(...[...found.min, ...found.max].map((value, i) => Math.abs(value - [...min, ...max][i])));
  assert.ok(off < 0.01, `${name} is at ${JSON.stringify(found)}, not ${min} to ${max}`);
}

test('head: bodies are where their links are, at two moments', async () => {
  const page = pages.head;
  await seek(page, 2); // The tip at 100, 50, 0; upright.
  await isAt(page, 'clamp', [60, -20, -20], [100, 20, 30]);
  await isAt(page, 'cup', [120, 120, -60], [180, 180, -20]);
  await isAt(page, 'part', [300, 0, -20], [380, 80, 40]);
  await isAt(page, 'gantry', [60, -300, 200], [140, 300, 240]);
  await isAt(page, 'motor', [60, 10, 220], [140, 90, 300]);
  await seek(page, 4); // The tip at 200, 50, 0; the tool along X: its nose is at X300, the X axis at 200 + 245.
  await isAt(page, 'clamp', [60, -20, -20], [100, 20, 30]);
  await isAt(page, 'gantry', [405, -300, 200], [485, 300, 240]);
  await isAt(page, 'motor', [420, 10, -40], [500, 90, 40]);
  await isAt(page, 'column', [500, -10, 0], [520, 10, 200]);
});

test('table: the workpiece rests, and the machine turns about it', async () => {
  const page = pages.table;
  await seek(page, 2);
  await isAt(page, 'motor', [60, 10, 220], [140, 90, 300]);
  await isAt(page, 'column', [500, -10, 0], [520, 10, 200]);
  await seek(page, 4); // As seen from the table, all is turned by 90 degrees about the B axis at Z-50.
  await isAt(page, 'clamp', [60, -20, -20], [100, 20, 30]);
  await isAt(page, 'motor', [420, 10, -40], [500, 90, 40]);
  await isAt(page, 'column', [50, -10, -570], [250, 10, -550]);
});

test('the tool is drawn by its shape, and one without any as before', async () => {
  const page = pages.head;
  const shown = () =>
    page.evaluate(() => {
      const { view } = globalThis.isocnc;
      return { parts: view.sceneModel.tool.children.length, standIn: view.tool.object.visible, head: view.head.object.visible, nose: view.sceneModel.nose.visible };
    });
  await seek(page, 2);
  assert.deepEqual(await shown(), { parts: 3, standIn: false, head: false, nose: true });
  await seek(page, 6);
  assert.deepEqual(await shown(), { parts: 1, standIn: false, head: false, nose: true });
});

test('each kind of body is in the picture, and can be left out', async () => {
  const page = pages.head;
  await page.keyboard.press('Shift+F');
  await seek(page, 2);
  for (const layer of ['fixtures', 'spoilboard', 'target', 'machine', 'tool', 'stock']) {
    await drawn(page);
    const before = await picture(page);
    await page.locator(`#layer-${layer}`).uncheck();
    await drawn(page);
    assert.notEqual(await picture(page), before, layer);
    await page.locator(`#layer-${layer}`).check();
  }
  for (const [name, machine] of Object.entries(pages)) {
    await machine.keyboard.press('Shift+F');
    for (const time of [2, 4, 6]) {
      await seek(machine, time);
      await drawn(machine);
      await keep(machine, `scene-${name}-${time}`);
    }
  }
});

test('fixtures have the color of fixtures where they are', async () => {
  const page = pages.head;
  await seek(page, 0);
  await page.getByRole('button', { name: 'Top', exact: true }).click();
  await page.locator('#layer-machine').uncheck();
  await drawn(page);
  // A place on the cup, away from edges and the path.
  const [r, g, b] = await colorAt(page, [140, 160, -20]);
  assert.ok(b > g && g > r && b - r > 30, `${[r, g, b]} is not a light blue`);
  await page.locator('#layer-machine').check();
});

test('contacts are listed, and a click brings the tool there and shows the line', async () => {
  const page = pages.head;
  const entries = page.locator('#contact-list button');
  assert.equal(await entries.count(), 2);
  assert.equal(await page.locator('#contacts-title').textContent(), 'Contacts: 2');
  assert.match(await entries.first().textContent(), /E152.*goes 2\.5 mm into clamp <b>.*line 4/);
  assert.equal(await page.locator('#certificate').textContent(), certificate.en);
  assert.equal(await page.locator('#ticks span').count(), 2);
  await entries.nth(1).click();
  assert.equal(await page.evaluate(() => globalThis.isocnc.player.time), 7.5);
  assert.equal(await currentLine(page), 8);
  assert.equal(await entries.nth(1).getAttribute('aria-current'), 'true');
  assert.equal(await entries.nth(0).getAttribute('aria-current'), null);
  // By keys, too.
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('Enter');
  assert.equal(await currentLine(page), 4);
  assert.equal(await page.evaluate(() => globalThis.isocnc.player.time), contacts[0].time);
  // Lines with a contact light it up: 4 and 5 for the first one.
  for (const [line, lit] of [[5, [0]], [7, []], [8, [1]], [3, []]]) {
    await page.locator('#program .line').nth(line - 1).click();
    const current = await entries.evaluateAll((all) => all.flatMap((each, i) => (each.getAttribute('aria-current') ? [i] : [])));
    assert.deepEqual(current, lit, `line ${line}`);
  }
});

test('the header counts contacts in the color of an error, and all is said in the language chosen', async () => {
  const page = pages.head;
  const outcome = page.locator('#outcome');
  assert.equal(await outcome.textContent(), 'ran to M02, 2 contacts');
  assert.equal(await outcome.getAttribute('class'), 'error');
  await page.locator('#language').click();
  assert.equal(await outcome.textContent(), 'eseguito fino a M02, 2 contatti');
  assert.match(await page.locator('#contact-list button').first().textContent(), /E152.*entra 2\.5 mm in clamp <b>.*riga 4/);
  assert.equal(await page.locator('#certificate').textContent(), certificate.it);
  await page.locator('#language').click();
});

test('bodies are colored while they are hit', async () => {
  const page = pages.head;
  const touched = () => page.evaluate(() => [...globalThis.isocnc.view.sceneModel.touchedNow].map(([{ name }, severity]) => `${name} ${severity}`));
  const color = (name) =>
    page.evaluate((of) => globalThis.isocnc.view.sceneModel.parts.find(({ body }) => body.name === of).mesh.material.color.getHex(), name);
  const isRed = (hex) => (hex >> 16) - Math.max((hex >> 8) & 0xff, hex & 0xff) > 70;
  await seek(page, 2.9);
  assert.deepEqual(await touched(), []);
  const free = await color('clamp');
  await seek(page, 3.5);
  assert.deepEqual(await touched(), ['clamp error']);
  assert.deepEqual([free, await color('clamp')].map(isRed), [false, true]);
  await page.locator('#theme').click();
  assert.equal(isRed(await color('clamp')), true);
  await page.locator('#theme').click();
  await seek(page, 4.6);
  assert.deepEqual(await touched(), []);
  assert.equal(await color('clamp'), free);
  await seek(page, 7.6);
  assert.deepEqual(await touched(), ['gantry warning']);
});

test('a contact out of sight is brought into view, and once more chosen from near', async () => {
  const page = pages.head;
  const entry = page.locator('#contact-list button').first();
  const stage = await page.locator('#stage').boundingBox();
  const at = () => project(page, contacts[0].point);
  const isInside = ({ x, y }) => x > 0 && x < stage.width && y > 0 && y < stage.height;
  const millimeters = async () => {
    const [from, to] = [await project(page, [0, 0, 0]), await project(page, [100, 0, 0])];
    return 100 / Math.hypot(to.x - from.x, to.y - from.y);
  };
  await page.getByRole('button', { name: 'Top', exact: true }).click();
  await page.keyboard.press('Shift+F');
  const far = await millimeters();
  // In sight, nothing moves.
  const before = await at();
  await entry.click();
  assert.deepEqual(await at(), before);
  await entry.click();
  assert.ok((await millimeters()) < far / 1.5, `${await millimeters()} of ${far} mm for a pixel`);
  const middle = await at();
  assert.ok(Math.abs(middle.y - stage.height / 2) < 2, JSON.stringify(middle));
  // Away, and back from the other contact, as near as before.
  await page.locator('#stage').focus();
  for (let i = 0; i < 12; ++i) await page.keyboard.press('+');
  await page.evaluate(() => globalThis.isocnc.view.approach([2000, 0, 0]));
  assert.equal(isInside(await at()), false);
  await page.keyboard.press('Home');
  await entry.click();
  assert.equal(isInside(await at()), true);
  await page.getByRole('button', { name: 'Iso' }).click();
  await page.keyboard.press('Shift+F');
});

test('a key goes from contact to contact, and back', async () => {
  const page = pages.head;
  const now = () => page.evaluate(() => globalThis.isocnc.player.time);
  await page.locator('#stage').focus();
  await page.keyboard.press('Home');
  for (const [key, time] of [['e', 3], ['e', 7.5], ['e', 7.5], ['Shift+E', 3], ['Shift+E', 3]]) {
    await page.keyboard.press(key);
    assert.equal(await now(), time, key);
  }
  assert.equal(await currentLine(page), 4);
  await seek(page, 5);
  await page.keyboard.press('Shift+E');
  assert.equal(await now(), 3);
});

test('bodies without a name are called what they are', async () => {
  const recording = sceneRecording('head');
  const { bodies } = recording.facts.scene;
  for (const body of bodies) if (['board', 'part'].includes(body.name)) body.name = '';
  recording.facts.contacts = [
    { ...contacts[0], code: 'E155', whom: 'the finished part' },
    { ...contacts[1], code: 'E153', whom: 'the spoilboard', time: 3.2 },
  ];
  const page = await open(pageWith(recording, program));
  await seek(page, 4);
  assert.deepEqual(
    await page.evaluate(() => [...globalThis.isocnc.view.sceneModel.touchedNow].map(([{ role }, severity]) => `${role} ${severity}`)),
    ['target error', 'spoilboard warning'],
  );
  await page.getByRole('button', { name: 'Top', exact: true }).click();
  await page.keyboard.press('Shift+F');
  await page.locator('#measure').click();
  await drawn(page);
  await page.locator('#stage').click({ position: await project(page, [-50, -60, -60]) });
  assert.match(await page.locator('#measurement').textContent(), /1: corner of the spoilboard/);
  await page.context().close();
});

test('marks of contacts stand at their points, and can be clicked', async () => {
  const page = pages.head;
  const markAt = (i) => page.evaluate((contact) => globalThis.isocnc.view.sceneModel.markAt(contact), i);
  await seek(page, 4);
  const onGantry = await markAt(1); // The X axis is at 445.
  assert.ok(Math.abs(onGantry[0] - 485) < 0.01, `${onGantry}`);
  assert.deepEqual(await markAt(0), contacts[0].point);
  await page.getByRole('button', { name: 'Iso' }).click();
  await drawn(page);
  await keep(page, 'scene-contacts');
  await page.locator('#stage').click({ position: await project(page, contacts[0].point) });
  assert.equal(await page.evaluate(() => globalThis.isocnc.player.time), contacts[0].time);
});

test('measures from corner to corner, from center to end of a move', async () => {
  const page = pages.head;
  await seek(page, 8);
  await page.getByRole('button', { name: 'Top', exact: true }).click();
  await page.locator('#layer-machine').uncheck();
  await page.keyboard.press('Shift+F');
  await page.locator('#measure').click();
  assert.equal(await page.locator('#measure').getAttribute('aria-pressed'), 'true');
  const choose = async (at, off = [3, -4]) => {
    await drawn(page);
    const { x, y } = await project(page, at);
    await page.locator('#stage').click({ position: { x: x + off[0], y: y + off[1] } });
  };
  const output = page.locator('#measurement');
  assert.equal(await output.textContent(), 'Choose the first place');
  await choose([60, -20, 30]);
  assert.match(await output.textContent(), /1: corner of clamp.*Choose the second place/);
  await choose([420, 240, -60]);
  const rows = async () => Object.fromEntries(await output.locator('dl div').evaluateAll((all) => all.map((row) => [...row.children].map((each) => each.textContent))));
  assert.deepEqual(await rows(), {
    distance: Math.hypot(360, 260, 90).toFixed(3),
    dX: '360.000',
    dY: '260.000',
    'dZ, depth': '-90.000',
    'angle in XY': `${((Math.atan2(260, 360) * 180) / Math.PI).toFixed(3)}°`,
  });
  await drawn(page);
  await keep(page, 'scene-measure');
  // The third place starts anew: the center of the cup, then the center of the arc.
  await choose([150, 150, -20]);
  assert.match(await output.textContent(), /^1: center of cup/);
  await choose([200, 90, 0]);
  assert.match(await output.textContent(), /2: center of an arc, line 5/);
  // Points are recorded to 0.001 mm.
  assert.ok(Math.abs(Number((await rows()).distance) - Math.hypot(50, -60, 20)) < 0.005);
  await choose([100, 50, 0]);
  assert.match(await output.textContent(), /^1: end of a move, line [234]/);
  await page.keyboard.press('Escape');
  assert.equal(await output.isVisible(), false);
  assert.equal(await page.locator('#measure').getAttribute('aria-pressed'), 'false');
  await page.locator('#layer-machine').check();
});

test('measures by keys alone', async () => {
  const page = pages.head;
  await page.locator('#program .line').nth(3 - 1).click(); // The tip at 100, 50, 0.
  await page.locator('#stage').focus();
  await page.keyboard.press('m');
  await page.keyboard.press('Enter');
  await page.keyboard.press('n'); // The corner of the clamp at 100, 20, -20 is nearest.
  assert.match(await page.locator('#measurement').textContent(), /1: tip of the tool, line 3.*corner of clamp/);
  await page.keyboard.press('Enter');
  assert.match(await page.locator('#measurement').textContent(), new RegExp(`distance${Math.hypot(30, 20).toFixed(3)}`));
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('#measurement').isVisible(), false);
});

test('measures by taps of a finger', async () => {
  const page = await open(files.head, { hasTouch: true, isMobile: true, viewport: { width: 390, height: 780 } });
  await page.getByRole('button', { name: 'Top', exact: true }).tap();
  await page.evaluate(() => globalThis.isocnc.view.fit(true));
  await page.locator('#measure').tap();
  const stage = await page.locator('#stage').boundingBox();
  // Fingers hit what they point at less closely than a mouse.
  for (const corner of [[-50, -60, -60], [420, -60, -60]]) {
    await drawn(page);
    const { x, y } = await project(page, corner);
    await page.touchscreen.tap(stage.x + x + 14, stage.y + y + 12);
  }
  assert.match(await page.locator('#measurement').textContent(), /1: corner of board2: corner of board.*distance470\.000/);
  await keep(page, 'scene-touch');
  await page.locator('#measure').tap();
  // A tap on the mark of a contact leads there.
  const mark = await project(page, contacts[0].point);
  await page.touchscreen.tap(stage.x + mark.x, stage.y + mark.y);
  assert.equal(await page.evaluate(() => globalThis.isocnc.player.time), contacts[0].time);
  await page.context().close();
});

test('hides by tool and by height', async () => {
  const page = pages.head;
  await page.getByRole('button', { name: 'Iso' }).click();
  await page.keyboard.press('Shift+F');
  await seek(page, 8);
  const hit = async (at) => {
    await drawn(page);
    const { x, y } = await project(page, at);
    const found = await page.evaluate(([px, py]) => globalThis.isocnc.view.pick(px, py), [x, y]);
    return found && page.evaluate(({ point }) => globalThis.isocnc.path.stepLine[globalThis.isocnc.path.pointStep[point]] + 1, found);
  };
  assert.equal(await hit([0, 0, 20]), 8);
  assert.equal(await hit([150, 50, 0]), 4);
  await page.keyboard.press('h');
  assert.equal(await page.locator('#hide').getAttribute('aria-expanded'), 'true');
  const before = await picture(page);
  await page.getByRole('checkbox', { name: 'T102002' }).uncheck();
  assert.equal(await hit([0, 0, 20]), null);
  assert.equal(await hit([150, 50, 0]), 4);
  await drawn(page);
  assert.notEqual(await picture(page), before);
  await keep(page, 'scene-hiding');
  await page.getByRole('button', { name: 'Show all' }).click();
  assert.equal(await hit([0, 0, 20]), 8);
  // The move of line 4 is blue as its tool, and the board under it, through the gantry, at most gray.
  const isLine4Drawn = async () => {
    const [r, , b] = await colorAt(page, [150, 50, 0]);
    return b > r + 60;
  };
  assert.equal(await isLine4Drawn(), true);
  await page.locator('#hiding-minZ').fill('-20');
  assert.equal(await isLine4Drawn(), true);
  await page.locator('#hiding-minZ').fill('10');
  assert.equal(await isLine4Drawn(), false);
  assert.equal(await hit([0, 0, 20]), 8);
  assert.equal(await hit([0, 0, 5]), null);
  assert.equal(await hit([150, 50, 0]), null);
  await page.locator('#hiding-maxZ').fill('15');
  assert.equal(await hit([0, 0, 20]), null);
  // Digits are of the field, and do not change from where one looks.
  await page.locator('#hiding-minZ').fill('');
  assert.equal(await hit([150, 50, 0]), 4);
  assert.ok(await page.locator('#hide').evaluate((button) => button.classList.contains('active')));
  await page.getByRole('button', { name: 'Show all' }).click();
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('#hiding').isVisible(), false);
});

test('a program without surroundings shows nothing of them', async () => {
  const page = await open(files.bare);
  assert.equal(await page.locator('#verification').isVisible(), false);
  assert.equal(await page.locator('#ticks span').count(), 0);
  for (const layer of ['fixtures', 'spoilboard', 'target', 'machine']) assert.equal(await page.locator(`#layer-${layer}`).count(), 0);
  assert.equal(await page.evaluate(() => globalThis.isocnc.view.sceneModel), null);
  // It can be measured and hidden all the same.
  await page.locator('#stage').focus();
  for (const key of ['m', 'Enter', 'End', 'Enter']) await page.keyboard.press(key);
  assert.match(await page.locator('#measurement').textContent(), /distance110\.000/);
  await keep(page, 'scene-bare');
  await page.context().close();
});

test('speaks Italian, in the dark, and fits a narrow window', async () => {
  const page = await open(files.threeAxis, { colorScheme: 'dark' });
  await page.locator('#language').click();
  await seek(page, 2);
  await page.keyboard.press('Shift+F');
  await drawn(page);
  assert.equal(await page.locator('#contacts-title').textContent(), 'Contatti: 2');
  await keep(page, 'scene-dark');
  const narrow = await open(files.head, { colorScheme: 'dark', viewport: { width: 420, height: 760 } });
  await seek(narrow, 4);
  await narrow.locator('#measure').click();
  await narrow.keyboard.press('Enter');
  await drawn(narrow);
  await keep(narrow, 'scene-narrow');
  const isInside = async (id) => {
    const box = await narrow.locator(`#${id}`).boundingBox();
    assert.ok(box && box.x >= 0 && box.x + box.width <= 420, `${id} is out of the window`);
    return box;
  };
  for (const id of ['looks', 'measurement', 'verification', 'scrubber', 'clock']) await isInside(id);
  // The entry of the line that is shown is in sight.
  await narrow.locator('#program .line').nth(7).click();
  const [entry, list] = [await narrow.locator('#contact-list button').nth(1).boundingBox(), await isInside('verification')];
  assert.ok(entry.y >= list.y - 1 && entry.y + entry.height <= list.y + list.height + 1, JSON.stringify([entry, list]));
  await narrow.keyboard.press('Escape');
  // What is shown is chosen behind a button, and nothing else covers the middle of the picture.
  const [looks, readout, picture] = [await isInside('looks'), await isInside('readout'), await isInside('picture')];
  assert.ok(looks.height < 50 && readout.height < 60 && picture.height > 250, JSON.stringify([looks, readout, picture]));
  assert.equal(await narrow.locator('#settings').isVisible(), false);
  await narrow.locator('#display').click();
  assert.equal(await narrow.locator('#display').getAttribute('aria-expanded'), 'true');
  await isInside('settings');
  await keep(narrow, 'scene-settings');
  await narrow.locator('#layer-grid').uncheck();
  await narrow.locator('#display').click();
  assert.equal(await narrow.locator('#settings').isVisible(), false);
  // A narrow picture that is tall has both.
  await narrow.setViewportSize({ width: 480, height: 1300 });
  await drawn(narrow);
  const [above, below] = await Promise.all(['settings', 'readout'].map((id) => narrow.locator(`#${id}`).boundingBox()));
  assert.ok(above && above.y + above.height <= below.y, JSON.stringify([above, below]));
  assert.equal(await narrow.locator('#display').isVisible(), false);
  await narrow.context().close();
  await page.context().close();
});

test('nothing has gone wrong', () => assert.deepEqual(problems, []));

// The examples of setups in the page of isorun --plot, as an operator opens them. With ISOCNC_SCREENSHOTS=docs/images it takes the pictures of the
// documentation that show this page.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { openBrowser } from './browser.mjs';
import { root, run, write } from './run.mjs';

const { open, close, drawn, keep, problems } = await openBrowser();
after(close);

/** The page of an example with the configuration beside it. */
async function pageOf(name, status, language = 'en', ...options) {
  const file = write(`${name.replaceAll('/', '-')}-${language}.html`, '');
  assert.equal(run('--lang', language, '--plot', file, ...options, join(root, 'examples', name)).status, status, name);
  return open(file, { viewport: { width: 1320, height: 720 } });
}

const touched = (page) => page.evaluate(() => [...globalThis.isocnc.view.sceneModel.touchedNow.keys()].map(({ name, role }) => name || role));
const entries = (page) => page.locator('#contact-list button');

test('programs without mistakes have no contacts', async () => {
  for (const name of ['panel', 'tilted', 'trim']) {
    const page = await pageOf(`setups/${name}.iso`, 0);
    assert.match(await page.locator('#certificate').textContent(), /^verified: \d+ motions, 0 contacts/);
    assert.equal(await page.locator('#outcome').textContent(), 'ran to M02');
    assert.equal(await entries(page).count(), 0);
    await page.context().close();
  }
});

test('a panel on cups: each contact is found, and where it is', async () => {
  const page = await pageOf('setups/broken/panel.iso', 1);
  assert.equal(await page.locator('#outcome').textContent(), 'ran to M02, 4 contacts');
  assert.equal(await page.locator('#layer-stock').isChecked(), true);
  for (const [i, body] of ['cup 2', 'cup 3', 'clamp 1', 'clamp 3'].entries()) {
    await entries(page).nth(i).click();
    assert.deepEqual(await touched(page), [body]);
  }
  await page.evaluate(() => {
    const { view, player } = globalThis.isocnc;
    view.orbit(-70, -4);
    view.fit();
    view.zoom(1.12);
    player.seek(player.time + 0.02);
  });
  assert.deepEqual(await touched(page), ['clamp 3']);
  await drawn(page);
  await keep(page, 'verification-panel');
  await page.context().close();
});

test('a block on five faces: the part is cut into', async () => {
  const page = await pageOf('setups/broken/tilted.iso', 1, 'it');
  assert.equal(await page.locator('#outcome').textContent(), 'eseguito fino a M02, 2 contatti');
  await entries(page).nth(1).click(); // The first is a rapid in the material.
  assert.deepEqual(await touched(page), ['target']);
  await page.context().close();
});

test('a shell that is trimmed with five axes: the form is hit', async () => {
  const page = await pageOf('setups/broken/trim.iso', 1);
  await entries(page).first().click();
  assert.deepEqual(await touched(page), ['form']);
  await entries(page).first().click();
  await page.evaluate(() => {
    const { view, path, player } = globalThis.isocnc;
    const [contact] = path.facts.contacts;
    player.seek((contact.time + contact.endTime) / 2);
    view.orbit(-75, -8);
    view.zoom(0.6);
  });
  await drawn(page);
  await keep(page, 'verification-trim');
  await page.context().close();
});

test('a program without a setup', async () => {
  const tools = [{ head: 1, holder: 1, tool: 18, name: 'fresa D10', length: 160, radius: 5 }];
  const page = await pageOf('five-axis.iso', 0, 'en', '--machine', write('tools.json', JSON.stringify({ machine: { tools } })));
  assert.equal(await page.locator('#verification').isVisible(), false);
  await page.locator('#program .line', { hasText: 'X402.5 Y215' }).click();
  await page.getByRole('radio', { name: 'Feed' }).check({ force: true });
  await page.evaluate(() => {
    const { view } = globalThis.isocnc;
    view.orbit(30, -4);
    view.fit();
    view.zoom(0.85);
  });
  await drawn(page);
  await keep(page, 'isorun-plot');
  await page.context().close();
});

test('nothing has gone wrong', () => assert.deepEqual(problems, []));

// The stock in the page of isorun, in a browser: cut up to the moment that is shown.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { openBrowser } from './browser.mjs';
import { freshPage, recordingOf } from './run.mjs';
import { panel } from './stock.mjs';

const { open, close, drawn, keep, picture, problems } = await openBrowser();
const recording = { ...recordingOf(panel.facts, panel.moves), cuts: panel.cuts };
let page;
before(async () => {
  page = await open(await freshPage('panel', recording, panel.program));
});
after(close);

/** When all of the stock is drawn. */
const settled = async (of) => {
  await of.waitForFunction(() => !globalThis.isocnc.view.stockModel.lastUpdate.isMore);
  await drawn(of);
};

test('the stock is shown and cut up to the moment', async () => {
  await settled(page);
  await keep(page, 'stock-blank');
  await page.keyboard.press('End');
  await settled(page);
  await keep(page, 'stock-end');
});

test('nothing has gone wrong', () => assert.deepEqual(problems, []));

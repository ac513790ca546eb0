// Pages in Chromium, from files, without any network.
import { existsSync, mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium, launchOptions } from '../chromium.mjs';
import { requireFromView, root, run, skip, write } from './run.mjs';

/** Ends the test as skipped where there is no browser, or no page to open. */
export async function openBrowser() {
  if (!existsSync(chromium)) skip(`there is no ${chromium}`);
  if (!existsSync(join(root, 'toolpath-view/node_modules/playwright-core')))
    skip('there is no playwright-core: npm ci --prefix toolpath-view');
  if (run('--plot', write('probe.html', ''), '--no-config', write('probe.iso', 'M02\n')).stderr.includes('npm'))
    skip('this isorun has no --plot FILE.html');

  const { chromium: driver } = requireFromView('playwright-core');
  const browser = await driver.launch(launchOptions);
  const problems = [];
  const requests = [];

  async function open(file, options = {}) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, offline: true, ...options });
    context.setDefaultTimeout(20_000);
    const page = await context.newPage();
    page.on('console', (message) => {
      // The software renderer speaks of its own speed.
      if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver Message/.test(message.text()))
        problems.push(message.text());
    });
    page.on('pageerror', (error) => problems.push(String(error)));
    page.on('request', (request) => requests.push(request.url()));
    await page.goto(pathToFileURL(file).href);
    await page.waitForSelector('html[data-ready]', { timeout: 60_000 });
    return page;
  }

  /** For people to look at: kept where ISOCNC_SCREENSHOTS names a folder. */
  async function keep(page, name) {
    if (!process.env.ISOCNC_SCREENSHOTS) return;
    mkdirSync(process.env.ISOCNC_SCREENSHOTS, { recursive: true });
    await page.screenshot({ path: join(process.env.ISOCNC_SCREENSHOTS, `${name}.png`) });
  }

  /** What a browser draws at last. */
  const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  /** Where a place of the machine is in the picture. */
  const project = (page, at) => page.evaluate((place) => globalThis.isocnc.view.project(place), at);

  /** The line of the program that is shown as the present one. */
  async function currentLine(page) {
    await drawn(page);
    return Number(await page.locator('#program .line.current .number').textContent());
  }

  /** What a picture, as base64, has where a place of the machine is: red, green, blue. */
  async function colorIn(page, picture, place) {
    const { x, y } = await project(page, place);
    return page.evaluate(
      async ([png, px, py]) => {
        const bytes = Uint8Array.from(atob(png), (each) => each.charCodeAt(0));
        const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
        context.drawImage(bitmap, 0, 0);
        return [...context.getImageData(Math.round(px), Math.round(py), 1, 1).data.slice(0, 3)];
      },
      [picture, x, y],
    );
  }

  return {
    open,
    keep,
    problems,
    requests,
    close: () => browser.close(),
    drawn,
    project,
    currentLine,
    colorIn,
    picture: async (page) => (await page.locator('#stage').screenshot()).toString('base64'),
  };
}

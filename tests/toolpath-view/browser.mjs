// Pages in Chromium, from files, without any network.
import { existsSync, mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { requireFromView, root, run, skip, write } from './run.mjs';

/** Ends the test as skipped where there is no browser, or no page to open. */
export async function openBrowser() {
  const chromium = process.env.CHROMIUM ?? '/usr/bin/chromium';
  if (!existsSync(chromium)) skip(`there is no ${chromium}`);
  if (!existsSync(join(root, 'toolpath-view/node_modules/playwright-core')))
    skip('there is no playwright-core: npm ci --prefix toolpath-view');
  if (run('--plot', write('probe.html', ''), '--no-config', write('probe.iso', 'M02\n')).stderr.includes('npm'))
    skip('this isorun has no --plot FILE.html');

  const { chromium: driver } = requireFromView('playwright-core');
  const browser = await driver.launch({
    executablePath: chromium,
    args: [
      '--no-sandbox',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      '--use-gl=angle',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
    ],
  });
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

  return {
    open,
    keep,
    problems,
    requests,
    close: () => browser.close(),
    /** What a browser draws at last. */
    drawn: (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))),
    picture: async (page) => (await page.locator('#stage').screenshot()).toString('base64'),
  };
}

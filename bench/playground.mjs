// Times how long the playground takes from the `load` event of its page to its first findings, in Chromium: node bench/playground.mjs [ROUNDS] [FOLDER]
// The page is that of build/web/playground, or of FOLDER. Each round starts a browser of its own, so that nothing is kept from the round before.
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch, onDisk } from '../tests/playground/browser.mjs';

const rounds = Number(process.argv[2] ?? 9);
const address = process.argv[3] ? pathToFileURL(join(resolve(process.argv[3]), 'index.html')).href : onDisk;
const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];

/** Runs in the page before its scripts: notes when the first findings stand in the list. */
function watch() {
  new MutationObserver(() => {
    if (globalThis.firstFindings || !document.querySelector('#findings[data-state=ready]')) return;
    globalThis.firstFindings = performance.now();
  }).observe(document, { subtree: true, childList: true, attributes: true, attributeFilter: ['data-state'] });
}

async function once() {
  const browser = await launch();
  try {
    const page = await browser.newPage();
    await page.addInitScript(watch);
    await page.goto(address);
    await page.waitForFunction(() => globalThis.firstFindings);
    return await page.evaluate(() => {
      const { loadEventEnd } = performance.getEntriesByType('navigation')[0];
      return { load: loadEventEnd, findings: globalThis.firstFindings };
    });
  } finally {
    await browser.close();
  }
}

const times = [];
for (let i = 0; i < rounds; ++i) times.push(await once());
const show = (name, values) => console.log(`| ${name} | ${median(values).toFixed(0)} ms | ${Math.max(...values).toFixed(0)} ms |`);
console.log(`| the playground's page, ${rounds} times | median | at worst |\n|---|---|---|`);
show('start to load', times.map(({ load }) => load));
show('load to first findings', times.map(({ load, findings }) => findings - load));
show('start to first findings', times.map(({ findings }) => findings));

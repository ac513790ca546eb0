// The playground as a reader uses it: in Chromium, from a disk and from a server of files.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { isDeepStrictEqual } from 'node:util';
import { gzipSync } from 'node:zlib';
import { findingsOf, fragment, launch, onDisk, patience, printed, root, serve, web } from './browser.mjs';

const square = `M06 T101001
S12000 M03
G92 X100 Y100 Z0
G00 X0 Y0 Z20
G01 Z-2 F1200
X200
Y150
X0 F4000
Y0
G00 Z20
M05
M02
`;
const example = (name) => readFileSync(join(root, 'examples', name), 'utf8');
const pictures = process.env.ISOCNC_SCREENSHOTS;

let browser;
let server;
const requests = [];
const problems = [];

/** A page that has loaded the module, and shows what it has found. */
async function open({ address = onDisk, program, ...options } = {}) {
  const page = await browser.newPage({ viewport: { width: 1360, height: 850 }, locale: 'en-US', colorScheme: 'light', ...options });
  page.setDefaultTimeout(patience);
  page.on('request', (request) => requests.push(request.url()));
  page.on('websocket', (socket) => requests.push(socket.url()));
  page.on('console', (message) => {
    if (message.type() === 'error') problems.push(message.text());
  });
  page.on('pageerror', (error) => problems.push(String(error)));
  await page.goto(address + (program === undefined ? '' : fragment(program)));
  await page.locator('#findings[data-state=ready]').waitFor({ state: 'attached' });
  if (program !== undefined) await shows(page, program);
  return page;
}

let shared;
/** A page that tests without a wish of their own share, with this program. */
async function show(program) {
  shared ??= await open();
  await shared.evaluate((hash) => {
    location.hash = '';
    location.hash = hash;
  }, fragment(program));
  await shows(shared, program);
  return shared;
}

const text = (page) => page.evaluate(() => globalThis.playground.editor.text);
/** Waits until the page answers with a value. */
async function becomes(page, read, expected) {
  for (const end = Date.now() + patience; Date.now() < end; await page.waitForTimeout(20))
    if (isDeepStrictEqual(await page.evaluate(read), expected)) return;
  assert.deepEqual(await page.evaluate(read), expected);
}
/** Waits until the page has the program, and what isolint finds in it. */
async function shows(page, program, language = 'en') {
  const findings = findingsOf(program, language);
  await becomes(page, () => globalThis.playground.editor.text, program);
  const shown = () => [...document.querySelectorAll('.finding .text')].map((each) => each.textContent);
  await becomes(page, shown, findings.map(({ message }) => message));
  return findings;
}
const drawn = async (page) => {
  await page.locator('#view[data-result]').waitFor({ state: 'attached' });
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
};
const standing = async (page) => {
  await page.locator('#run[data-state=stopped]').waitFor();
  return { where: await page.locator('#run-state').innerText(), values: await page.locator('#values').innerText(), tip: await page.evaluate(() => globalThis.playground.toolpath.tip) };
};
/** Presses a button that moves the machine; what is shown then. */
async function press(page, name) {
  const before = await page.locator('#run-state').innerText();
  await page.locator(`#${name}`).click();
  await page.waitForFunction((old) => document.getElementById('run-state').textContent !== old, before);
  return standing(page);
}

before(async () => {
  [browser, server] = [await launch(), await serve()];
});
after(async () => {
  await browser?.close();
  server?.close();
});

test('it opens from a disk and from a server, and shows what isolint finds', async () => {
  for (const address of [onDisk, `${server.address}/playground/index.html`]) {
    const page = await open({ address });
    const findings = await shows(page, await text(page));
    assert.ok(findings.length > 1);
    await drawn(page);
    assert.match(await page.locator('#private').innerText(), /Nothing you type leaves this browser/);
    assert.equal(await page.locator('#outcome').innerText(), `stopped by an error on line ${findings.find(({ severity }) => severity === 'error').line}`);
    await page.close();
  }
});

test('it says what is missing where its module does not come, or is cut off', async () => {
  const context = await browser.newContext({ locale: 'en-US' });
  const whole = readFileSync(join(web, 'playground/module.js'), 'utf8');
  // The module is the longest text of its script.
  const [module] = whole.match(/"[A-Za-z0-9+/=]{100000,}"/);
  for (const [script, said] of [['', /module\.js/], [whole.replace(module, `${module.slice(0, 40001)}"`), /./]]) {
    const page = await context.newPage();
    page.setDefaultTimeout(patience);
    await page.route('**/module.js', (route) => route.fulfill({ contentType: 'text/javascript', body: script }));
    await page.goto(`${server.address}/playground/index.html`);
    await page.locator('#findings[data-state=failed]').waitFor({ state: 'attached' });
    assert.match(await page.locator('#findings-list').innerText(), said);
    await page.close();
  }
  await context.close();
});

test('a slip is found while it is typed, at its line, and its fix takes it away', async () => {
  const page = await show(square);
  assert.equal(await page.locator('.finding').count(), 0);
  await page.evaluate(() => {
    globalThis.playground.editor.go(6, 4);
    globalThis.playground.editor.focus();
  });
  await page.keyboard.type('\nG17\nG17');
  await page.locator('.finding').waitFor();
  const typed = square.replace('Y150\n', 'Y150\nG17\nG17\n');
  const [finding, ...others] = await shows(page, typed);
  assert.deepEqual([finding.line, finding.code, others], [9, 'W001', []]);
  assert.match(await page.locator('.finding .go').innerText(), /line 9/);
  await page.locator('.finding .code').click();
  await page.locator('#explanation pre').first().waitFor();
  assert.match(await page.locator('#explanation').innerText(), /^W001 .*\n[^]*Wrong:/);
  await page.locator('.finding .fix').click();
  await page.locator('.finding').waitFor({ state: 'detached' });
  assert.deepEqual(findingsOf(await text(page)), []);
  assert.doesNotMatch(await text(page), /G17\s+G17|isolint/);
  // Undo brings it back.
  await page.evaluate(() => globalThis.playground.editor.focus());
  await page.keyboard.press('Control+z');
  await shows(page, typed);
  await page.locator('#fix-all').click();
  await page.locator('.finding').waitFor({ state: 'detached' });
});

test('a finding leads to its line', async () => {
  const page = await show(example('broken/option.iso'));
  const findings = findingsOf(example('broken/option.iso'));
  await page.locator('.finding .go').nth(1).click();
  await page.keyboard.type('7');
  const changed = (await text(page)).split('\n');
  const before = example('broken/option.iso').split('\n');
  assert.deepEqual(changed.flatMap((line, i) => (line === before[i] ? [] : [i + 1])), [findings[1].line]);
});

test('it completes what is typed', async () => {
  const page = await show(square);
  await page.evaluate(() => {
    globalThis.playground.editor.go(6, 4);
    globalThis.playground.editor.focus();
  });
  await page.keyboard.type('\nG0');
  await page.locator('.suggest-widget .monaco-list-row').first().waitFor();
  assert.match(await page.locator('.suggest-widget').innerText(), /G02/);
  await page.keyboard.press('Escape');
});

test('a word is explained when the mouse is on it', async () => {
  const page = await show(square);
  await page.locator('.view-line', { hasText: 'T101001' }).first().getByText('T101001').hover();
  const hover = page.locator('.monaco-hover:not(.hidden) .monaco-hover-content', { hasText: 'T101001' });
  await hover.first().waitFor();
  assert.match(await hover.first().innerText(), /head 1, holder 1, tool 1/);
  await page.mouse.move(0, 0);
});

test('it formats as isofmt does', async () => {
  const program = 'm06t101001\ng0x0y0z20\ng1z-2f1200\nx1.50\nm2\n';
  const page = await show(program);
  await page.locator('#format').click();
  await shows(page, printed('isofmt', ['--no-config', '--stdout', '-'], program));
});

test('it steps, steps back to the same state, runs to a breakpoint, and ends', async () => {
  const page = await show(square);
  await drawn(page);
  await page.locator('#start').click();
  const start = await standing(page);
  const seen = [start];
  for (let i = 0; i < 6; ++i) seen.push(await press(page, 'step'));
  assert.deepEqual(seen.map(({ where }) => where), [1, 2, 3, 4, 5, 6, 7].map((line) => `Before line ${line}`));
  assert.match(seen[6].values, /X 200\.000\s+Y 0\.000\s+Z -2\.000[^]*F 1200[^]*M03 S12000[^]*T101001/);
  assert.deepEqual(seen[6].tip.map((value) => Math.round(value)), [300, 100, -2]);
  for (let i = 5; i >= 0; --i) assert.deepEqual(await press(page, 'back'), seen[i]);
  await page.keyboard.press('F10');
  await page.getByText('Before line 2').waitFor();
  await page.locator('.line-numbers', { hasText: /^9$/ }).click();
  assert.equal((await press(page, 'continue')).where, 'Before line 9');
  await page.locator('#continue').click();
  await page.locator('#run[data-state=ended]').waitFor();
  assert.match(await page.locator('#values').innerText(), /X 0\.000\s+Y 0\.000\s+Z 20\.000/);
});

test('a run stops where the control would, and goes back from there', async () => {
  const program = square.replace('X0 F4000', 'X0 F4000 J5');
  const [{ line, message }] = findingsOf(program);
  const page = await show(program);
  await page.locator('#start').click();
  await standing(page);
  const { where } = await press(page, 'continue');
  assert.match(where, new RegExp(`^Stopped by an error on line ${line}: .`), message);
  assert.match((await press(page, 'back')).where, /^Before line/);
  // An edit ends the run: it would be of another program.
  await page.evaluate(() => globalThis.playground.editor.focus());
  await page.keyboard.type(';');
  await page.locator('#run[data-state=edited]').waitFor();
});

test('a line lights its moves up, and a move leads to its line', async () => {
  const page = await show(square);
  await drawn(page);
  await page.evaluate(() => globalThis.playground.editor.go(5));
  const at = () => globalThis.playground.toolpath.tip.map((value) => Math.round(value));
  await becomes(page, at, [300, 100, -2]);
  await page.locator('#looks button', { hasText: 'Top' }).click();
  await drawn(page);
  const position = await page.evaluate(() => globalThis.playground.toolpath.project([250, 250, -2]));
  await page.locator('#stage').click({ position });
  await page.evaluate(() => globalThis.playground.editor.focus());
  await page.keyboard.type('7');
  const lines = (await text(page)).split('\n');
  assert.deepEqual(lines.flatMap((line, i) => (line === square.split('\n')[i] ? [] : [i + 1])), [8]);
});

test('a program that stops before its first move has a picture, too', async () => {
  const page = await show(example('broken/pocket.iso'));
  await drawn(page);
  assert.equal(await page.locator('#stage canvas').count(), 1);
  assert.equal(await page.locator('#stage .problem').count(), 0);
});

test('a link holds the program, and says so where it is damaged', async () => {
  const program = `${square}; caffè, ½\n`;
  const page = await show(program);
  await page.locator('#share').click();
  await page.locator('#share-dialog').waitFor();
  const link = await page.locator('#link').inputValue();
  await page.locator('#close-share').click();
  const other = await open({ address: link });
  await shows(other, program);
  for (const [end, said] of [[link.slice(0, -9), /damaged: it ends too early/], [`${link}%21`, /damaged: it has letters/], [onDisk + fragment('X'.repeat(5e6)), /damaged: it is too large/]]) {
    await other.evaluate((hash) => (location.hash = hash), end.slice(end.indexOf('#')));
    await other.waitForFunction((wanted) => new RegExp(wanted).test(document.getElementById('notice-text').textContent), said.source);
    assert.equal(await text(other), program);
  }
  await other.evaluate((hash) => (location.hash = hash), fragment(square));
  await shows(other, square);
  assert.ok(await other.locator('#notice').isHidden());
  await other.close();
});

test('a program that is too long for a link stays where it is', async () => {
  const digits = Array.from({ length: 20_000 }, (_, i) => `X${((i * 7919) % 100_003) / 100}`).join('\n');
  const page = await show(square);
  await page.evaluate((long) => globalThis.playground.editor.replace(long), digits);
  await page.locator('#share').click();
  await page.locator('#notice').waitFor();
  assert.match(await page.locator('#notice').innerText(), /too long for a link/);
});

test('what is typed is there when the page is loaded anew, until another link comes', async () => {
  const page = await open({ program: square });
  await page.evaluate(() => globalThis.playground.editor.apply([{ range: { startLineNumber: 7, startColumn: 2, endLineNumber: 7, endColumn: 5 }, text: '333' }]));
  const typed = square.replace('Y150', 'Y333');
  await shows(page, typed);
  await page.reload();
  await shows(page, typed);
  assert.equal(await page.locator('#name').innerText(), 'program.iso');
  await page.goto('about:blank');
  await page.goto(onDisk + fragment(`${square};other\n`));
  await shows(page, `${square};other\n`);
  await page.close();
});

test('a file that is dropped is opened, unless it is no text', async () => {
  const page = await show(square);
  const drop = (name, bytes) =>
    page.evaluate(
      ([file, content]) => {
        const dataTransfer = new DataTransfer();
        dataTransfer.items.add(new File([Uint8Array.from(content)], file));
        for (const type of ['dragenter', 'dragover', 'drop'])
          document.querySelector('.monaco-editor').dispatchEvent(new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true }));
      },
      [name, [...bytes]],
    );
  await drop('picture.png', [0x89, 0x50, 0, 1]);
  await page.locator('#notice').waitFor();
  assert.equal(await page.locator('#notice-text').innerText(), 'picture.png is no text.');
  assert.equal(await text(page), square);
  // As an old system writes è.
  await drop('caffe.iso', Buffer.from('; caff\xe8\r\nM02\r\n', 'latin1'));
  await shows(page, '; caffè\r\nM02\r\n');
  assert.equal(await page.locator('#name').innerText(), 'caffe.iso');
  assert.ok(await page.locator('#notice').isHidden());
  const download = page.waitForEvent('download');
  await page.locator('#save').click();
  const saved = await download;
  assert.equal(saved.suggestedFilename(), 'caffe.iso');
  assert.equal(readFileSync(await saved.path(), 'utf8'), '; caffè\r\nM02\r\n');
});

test('what is hostile in a link or a file is shown as text: no script runs, and nothing is fetched', async () => {
  const markup = '<img src=/leak.png onerror="globalThis.isHit=1"><script>globalThis.isHit=1</script><a href="javascript:globalThis.isHit=1">a</a>';
  const program = `${square.replace('M05\n', '')}; ${markup} ![i](/leak.png) [l](javascript:globalThis.isHit=1)\nX<b>1${markup}\nG01 X"${markup}"\n`;
  const page = await open({ address: `${server.address}/playground/index.html`, program });
  await drawn(page);
  const asked = server.asked.length;
  const isHarmless = async (what) => {
    const [isHit, elements] = await page.evaluate(() => [
      globalThis.isHit ?? 0,
      [...document.querySelectorAll('img, iframe, object, embed, a[href^="javascript:"], script:not([src])')].map((each) => each.outerHTML),
    ]);
    assert.deepEqual([isHit, elements, server.asked.slice(asked)], [0, [], []], what);
  };
  assert.ok((await page.locator('.finding').count()) > 0);
  await isHarmless('findings');
  // The hover of a block whose finding quotes it.
  await page.locator('.view-line', { hasText: 'X<b>1' }).first().getByText('<b>').first().hover();
  await page.locator('.monaco-hover:not(.hidden) .monaco-hover-content').first().waitFor();
  await isHarmless('hover');
  await page.mouse.move(1, 1);
  for (const end of [`#program=${markup}`, `#program=${encodeURIComponent(markup)}`, '#program=__proto__', `#program=${'A'.repeat(99_999)}`, `#${markup}`, '#program=', '#program=constructor&x=1']) {
    await page.evaluate((hash) => (location.hash = hash), end);
    await page.waitForTimeout(50);
    await isHarmless(end.slice(0, 40));
    assert.equal(await text(page), program);
  }
  await page.evaluate(
    ([name, content]) => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([content], name));
      document.body.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true }));
    },
    [`${markup}.iso`, `${square}; ${markup}\n`],
  );
  await shows(page, `${square}; ${markup}\n`);
  assert.equal(await page.locator('#name').innerText(), `${markup}.iso`);
  await isHarmless('a dropped file');
  await page.close();
});

test('examples are those of the repository', async () => {
  const page = await open();
  const count = await page.locator('#examples optgroup option').count();
  assert.ok(count > 10);
  for (const [index, folder] of [[0, ''], [count - 1, 'broken']]) {
    await page.locator('#examples').selectOption(String(index));
    await shows(page, example(join(folder, await page.locator('#name').innerText())));
    // The comment at their start has its color.
    await becomes(page, () => getComputedStyle(document.querySelector('.view-line span span')).color, 'rgb(79, 116, 87)');
  }
  await page.close();
});

test('it speaks both languages, and remembers which', async () => {
  const program = example('broken/option.iso');
  const context = await browser.newContext({ locale: 'it-IT', viewport: { width: 1360, height: 850 } });
  const visit = async () => {
    const page = await context.newPage();
    page.setDefaultTimeout(patience);
    await page.goto(`${server.address}/playground/index.html${fragment(program)}`);
    return page;
  };
  const page = await visit();
  await shows(page, program, 'it');
  assert.match(await page.locator('#private').innerText(), /Niente di quello che scrivi lascia il browser/);
  assert.equal(await page.locator('html').getAttribute('lang'), 'it');
  await page.locator('#language').click();
  await shows(page, program, 'en');
  assert.equal(await page.locator('#format').innerText(), 'Format');
  await page.close();
  const again = await visit();
  await shows(again, program, 'en');
  await drawn(again);
  const unnamed = await again.evaluate(() =>
    [...document.querySelectorAll('button, select, input:not([type=file]), [role=tab]')]
      .filter((each) => !(each.textContent.trim() || each.getAttribute('aria-label') || each.title || each.labels?.length))
      .map((each) => each.outerHTML),
  );
  assert.deepEqual(unnamed, []);
  await context.close();
});

test('it is dark where the system is, until the reader chooses', async () => {
  const page = await open({ colorScheme: 'dark' });
  const background = () => getComputedStyle(document.querySelector('.monaco-editor')).backgroundColor;
  assert.equal(await page.evaluate(background), 'rgb(26, 30, 37)');
  await page.locator('#theme').click();
  await becomes(page, background, 'rgb(255, 255, 255)');
  await page.close();
});

test('on a phone its parts are tabs, and nothing is cut off', async () => {
  for (const locale of ['en-US', 'it-IT']) {
    const page = await open({ viewport: { width: 390, height: 780 }, isMobile: true, hasTouch: true, locale });
    for (const part of ['source', 'findings', 'toolpath']) {
      await page.locator(`#tab-${part}`).click();
      for (const other of ['source', 'findings', 'toolpath']) assert.equal(await page.locator(`#${other}`).isVisible(), other === part);
      const outside = await page.evaluate((width) =>
        [...document.querySelectorAll('header *, #tabs *, .bar *, footer *, #run *, .overlay')]
          .filter((each) => each.checkVisibility() && !each.closest('.hidden') && each.getBoundingClientRect().right > width)
          .map((each) => each.id || each.outerHTML), 390);
      assert.deepEqual(outside, [], `${locale}: ${part}`);
    }
    await drawn(page);
    await page.locator('#tab-toolpath').focus();
    await page.keyboard.press('ArrowLeft');
    assert.ok(await page.locator('#findings').isVisible());
    await page.close();
  }
});

test('at every width the header is whole, says that nothing leaves the browser, and leaves room for the program', async () => {
  for (const locale of ['en-US', 'it-IT'])
    for (const [width, height] of [[320, 640], [600, 900], [768, 1024], [844, 390], [880, 800], [1024, 600], [1400, 900]]) {
      const page = await open({ viewport: { width, height }, locale });
      const header = await page.evaluate(() => {
        const isOutside = (each) => each.checkVisibility() && (each.getBoundingClientRect().right > document.documentElement.clientWidth || each.getBoundingClientRect().left < 0);
        const editor = document.querySelector('#editor').getBoundingClientRect().height;
        return { outside: [...document.querySelectorAll('#top *')].filter(isOutside).map((each) => each.id || each.outerHTML), isSaid: document.querySelector('#private').checkVisibility(), editor };
      });
      assert.deepEqual([header.outside, header.isSaid], [[], true], `${locale}, ${width} x ${height}`);
      assert.ok(header.editor > 120, `${locale}, ${width} x ${height}: ${header.editor} px`);
      await page.close();
    }
});

test('nothing leaves the browser, even where a script tries', async () => {
  const own = new Set(readdirSync(join(web, 'playground')));
  const address = `${server.address}/playground/`;
  const folder = new URL('.', onDisk).href;
  const strange = requests.filter((url) => {
    const [path] = url.split('#');
    const name = path.startsWith(address) ? path.slice(address.length) : path.startsWith(folder) ? path.slice(folder.length) : null;
    return !(name !== null && own.has(name)) && !path.startsWith('blob:') && !path.startsWith('data:');
  });
  assert.deepEqual(strange, []);
  assert.ok(requests.length > 10);

  const page = await open({ address: `${address}index.html` });
  const asked = server.asked.length;
  const said = problems.length;
  const tries = await page.evaluate(async () => {
    const failed = async (attempt) => attempt().then(() => false, () => true);
    return [
      await failed(() => fetch('/leak')),
      await failed(() => new Promise((resolve, reject) => Object.assign(new Image(), { onload: resolve, onerror: reject, src: '/leak.png' }))),
      await failed(() => new Promise((resolve, reject) => document.body.append(Object.assign(document.createElement('iframe'), { src: '/leak.html' })) ?? setTimeout(reject, 300))),
      await failed(() => new Promise((resolve, reject) => Object.assign(new WebSocket(`ws://${location.host}/leak`), { onopen: resolve, onerror: reject }))),
    ];
  });
  assert.deepEqual(tries, [true, true, true, true]);
  assert.deepEqual(server.asked.slice(asked), []);
  problems.splice(said); // Of the policy, about these tries.
  await page.close();
});

test('it is small enough to be loaded', () => {
  const bytes = readdirSync(join(web, 'playground')).reduce((sum, name) => sum + gzipSync(readFileSync(join(web, 'playground', name))).length, 0);
  assert.ok(bytes < 3e6, `${bytes}`);
});

test('pictures for the documentation', { skip: pictures ? false : 'ISOCNC_SCREENSHOTS is not set' }, async () => {
  const settled = (page) => page.waitForTimeout(1500);
  for (const theme of ['light', 'dark']) {
    const page = await open({ colorScheme: theme, viewport: { width: 1440, height: 860 } });
    await drawn(page);
    if (theme === 'light') {
      await page.locator('.finding .code').first().click();
      await page.locator('#start').click();
      await standing(page);
      for (let i = 0; i < 9; ++i) await press(page, 'step');
    } else {
      await page.locator('#language').click();
      await page.locator('#examples').selectOption({ label: 'Cinque facce' });
      await settled(page);
      await page.evaluate(() => globalThis.playground.editor.go(20));
    }
    await settled(page);
    await page.screenshot({ path: join(pictures, `playground-${theme}.png`) });
    await page.close();
  }
  const phone = await open({ viewport: { width: 390, height: 780 }, isMobile: true, hasTouch: true, program: example('pocket.iso') });
  await phone.locator('#tab-toolpath').click();
  await drawn(phone);
  await phone.locator('#start').click();
  await standing(phone);
  for (let i = 0; i < 12; ++i) await press(phone, 'step');
  await settled(phone);
  await phone.screenshot({ path: join(pictures, 'playground-phone.png') });
  await phone.close();
});

test('nothing has gone wrong', () => assert.deepEqual(problems, []));

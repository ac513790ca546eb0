// The npm package: its functions say what the native programs say, and its commands run where it is installed.
//
// usage: node package_test.mjs NATIVE PACKAGE    (folders of programs, and of the package)
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';

const [native, made] = process.argv.slice(2).map((folder) => resolve(folder));
const examples = fileURLToPath(new URL('../../examples', import.meta.url));
const { check, diff, format, run, CommandError } = await import(pathToFileURL(join(made, 'dist/index.js')).href);
const broken = readFileSync(join(examples, 'broken/pocket.iso'), 'utf8');
const pocket = readFileSync(join(examples, 'pocket.iso'), 'utf8');
const folder = mkdtempSync(join(tmpdir(), 'isocnc-npm-'));
after(() => rmSync(folder, { recursive: true }));

/** What a native program prints. */
function printed(program, args, input) {
  return spawnSync(join(native, program), [...args, '-'], { input, encoding: 'utf8' }).stdout;
}

test('check() finds what isolint finds, in both languages', async () => {
  for (const language of ['en', 'it']) {
    const args = ['--no-config', '--format', 'json', '--lang', language, '--stdin-filename', 'part.iso'];
    const findings = await check(broken, { language, filename: 'part.iso' });
    assert.ok(findings.length > 5);
    assert.deepEqual(findings, JSON.parse(printed('isolint', args, broken)));
  }
  assert.deepEqual(await check(pocket), []);
});

test('a configuration and options count', async () => {
  const off = { lint: { severity: { ISO035: 'off' } } };
  for (const configuration of [off, `// ${'x'}\n${JSON.stringify(off)}`])
    assert.ok((await check(broken, { configuration })).every(({ code }) => code !== 'ISO035'));
  assert.ok((await check(broken, { args: ['--select', 'ISO035'] })).every(({ code }) => code === 'ISO035'));
  assert.ok((await check(broken)).some(({ code }) => code === 'ISO035')); // Nothing is left behind.
});

test('format() writes what isofmt writes', async () => {
  const text = 'n10 g1x5.50 y-.5;caffè\r\nm2\r\n';
  assert.equal(await format(text), printed('isofmt', ['--no-config', '--stdout'], text));
  assert.equal(await format(text, { args: ['--g-digits', '2'] }), printed('isofmt', ['--no-config', '--stdout', '--g-digits', '2'], text));
});

test('characters of any length stand wherever the module reads on', async () => {
  for (const shift of ['', 'x', 'xx', 'xxx']) {
    const text = `${`;${shift}${'aè€🔧'.repeat(9)}\n`.repeat(3000)}M02\n`;
    assert.equal(await format(text), printed('isofmt', ['--no-config', '--stdout'], text));
  }
  assert.equal(await format(';\ud800\nM02\n'), ';\ufffd\nM02\n'); // Half a character.
});

test('run() tells what isorun tells', async () => {
  const { trace, ...summary } = await run(pocket, { trace: true });
  assert.deepEqual(summary, { ...JSON.parse(printed('isorun', ['--no-config', '--json'], pocket)), file: summary.file });
  const lines = printed('isorun', ['--no-config', '--trace', '-'], pocket).trimEnd().split('\n');
  assert.deepEqual(trace, lines.map((line) => JSON.parse(line)));
  assert.equal((await run(broken)).result, 'error');
});

test('diff() tells what isodiff tells', async () => {
  writeFileSync(join(folder, 'new.iso'), broken);
  writeFileSync(join(folder, 'old.iso'), pocket);
  const args = ['--no-config', '--format', 'json', '--lang', 'it', join(folder, 'old.iso'), join(folder, 'new.iso')];
  const differing = spawnSync(join(native, 'isodiff'), args, { encoding: 'utf8' });
  assert.equal(differing.status, 1);
  assert.deepEqual(await diff(pocket, broken, { language: 'it' }), JSON.parse(differing.stdout));
  assert.deepEqual(await diff(pocket, await format(pocket), { args: ['--ignore', 'comments'] }).then(({ same, changes }) => [same, changes]), [true, []]);
  await assert.rejects(diff(undefined, pocket), TypeError);
  await assert.rejects(diff(pocket, pocket, { args: ['--tolerance', '-1'] }), (error) => error instanceof CommandError && /--tolerance/.test(error.message));
});

test('the machine is asked with the setup and the meshes beside the program', async () => {
  const setups = join(examples, 'setups');
  const command = (name) => spawnSync(process.execPath, [join(made, 'bin', `${name}.js`), '--verify', '--lang', 'en', 'broken/trim.iso'], { cwd: setups, encoding: 'utf8' });
  for (const name of ['isolint', 'isorun']) assert.match(command(name).stdout, /error\[E152\].*\bform\b/, name);
  const trim = readFileSync(join(setups, 'broken/trim.iso'), 'utf8');
  const { machine, setups: all } = JSON.parse(readFileSync(join(setups, 'isocnc.json'), 'utf8').replaceAll(/^\s*\/\/.*$/gm, ''));
  const setup = all.find((each) => each.paths.includes('trim.iso'));
  delete setup.paths;
  setup.fixtures.find(({ mesh }) => mesh).mesh = 'stl/form.stl';
  const files = { 'part.setup.json': JSON.stringify(setup), 'stl/form.stl': readFileSync(join(setups, 'form.stl')) };
  const options = { configuration: { machine }, filename: 'part.iso', args: ['--verify'] };
  const codes = async (given) => (await check(trim, { ...options, ...given })).map(({ code }) => code);
  assert.ok((await codes({ files })).includes('E152'));
  assert.ok(!(await codes({})).includes('E152')); // Nothing is left behind.
  await assert.rejects(codes({ files: { 'part.setup.json': files['part.setup.json'] } }), (error) => error instanceof CommandError && /form\.stl/.test(error.message));
  for (const name of ['../x.stl', '/x.stl', 'a//x.stl', '']) await assert.rejects(codes({ files: { [name]: '' } }), CommandError);
});

test('calls at the same time load the module once', () => {
  const script = `
    let made = 0;
    const { instantiate } = WebAssembly;
    WebAssembly.instantiate = (...all) => { ++made; return instantiate(...all); };
    const { check } = await import(${JSON.stringify(pathToFileURL(join(made, 'dist/index.js')).href)});
    await Promise.all(['M02', 'M03', 'M05'].map((text) => check(text)));
    console.log(made);
  `;
  assert.equal(execFileSync(process.execPath, ['--input-type=module', '--eval', script], { encoding: 'utf8' }), '1\n');
});

test('mistakes are errors that say what is wrong', async () => {
  await assert.rejects(check('', { configuration: { machin: {} } }), (error) => error instanceof CommandError && /machin: unknown key/.test(error.message));
  for (const args of [['--list-rules'], ['--statistics'], ['--version']]) await assert.rejects(check('X', { args }), CommandError);
  for (const options of [{ lang: 'it' }, 'it', { language: 5 }, { filename: 5 }, { files: { 'x.stl': 5 } }]) await assert.rejects(check('', options), CommandError);
  for (const text of [undefined, null, new Uint8Array([77, 48, 50])]) await assert.rejects(check(text), TypeError);
  await assert.rejects(format('', { args: ['--bogus'] }), (error) => error instanceof CommandError && /--bogus/.test(error.message));
  await assert.rejects(check('\0'.repeat(100)), CommandError);
  assert.deepEqual((await check('G01 X1\nM02')).length > 0, true); // It goes on.
});

test('many calls at once each get their own answer', async () => {
  const texts = Array.from({ length: 20 }, (_, i) => 'G77\n'.repeat(i) + 'M02\n');
  const counts = (await Promise.all(texts.map((text) => check(text, { args: ['--select', 'E001'] })))).map((findings) => findings.length);
  const alone = [];
  for (const text of texts) alone.push((await check(text, { args: ['--select', 'E001'] })).length);
  assert.deepEqual(counts, alone);
  assert.ok(alone[1] > alone[0]);
});

test('it is packed, installed, and its commands run', () => {
  const npm = (...args) => execFileSync('npm', [...args, '--offline', '--no-audit', '--no-fund', '--loglevel=error'], { cwd: folder, encoding: 'utf8' });
  const [packed] = JSON.parse(npm('pack', made, '--json'));
  writeFileSync(join(folder, 'package.json'), '{"private": true}');
  npm('install', join(folder, packed.filename));
  writeFileSync(join(folder, 'part.iso'), broken);
  const command = (name, ...args) => spawnSync(join(folder, 'node_modules/.bin', name), args, { cwd: folder, encoding: 'utf8' });
  const found = command('isolint', '--lang', 'en', 'part.iso');
  assert.equal(found.status, 1);
  assert.match(found.stderr, /\d+ errors, 0 warnings in 1 file/);
  assert.ok(!found.stdout.includes('\u001b')); // A pipe is no terminal.
  assert.equal(command('isolint', 'nowhere.iso').status, 2);
  assert.equal(command('isofmt', '-i', 'part.iso').status, 0);
  assert.equal(command('isorun', '--plot', 'part.html', 'part.iso').status, 1);
  assert.match(readFileSync(join(folder, 'part.html'), 'utf8'), /<html/);
  const files = packed.files.map(({ path }) => path);
  for (const file of ['README.md', 'LICENSE', 'dist/index.d.ts']) assert.ok(files.includes(file), file);
});

test('its types compile where programs in TypeScript use it', () => {
  const source = `import { check, CommandError, diff, format, run, type Comparison, type Finding, type Run } from 'isocnc';
export async function use(): Promise<number> {
  const findings: Finding[] = await check('M02', { language: 'it', files: { 'part.stl': new Uint8Array(3) } });
  const ran: Run = await run(await format('M02'), { trace: true });
  const compared: Comparison = await diff('M02', 'M02');
  if (compared.findings.some((each) => each.kind === 'gone')) throw new CommandError(compared.old.tools.map((each) => each.tool).join());
  return findings.length + (ran.trace ?? []).length + compared.new.feedMm + (compared.new.extents?.X[0] ?? 0);
}
`;
  writeFileSync(join(folder, 'use.ts'), source);
  const tsc = new URL('../../web/node_modules/typescript/bin/tsc', import.meta.url).pathname;
  for (const options of [['--module', 'nodenext'], ['--module', 'es2022', '--moduleResolution', 'bundler'], ['--module', 'es2022', '--moduleResolution', 'node']]) {
    const compiled = spawnSync(process.execPath, [tsc, '--noEmit', '--strict', '--target', 'es2022', '--lib', 'es2022,dom', ...options, 'use.ts'], { cwd: folder, encoding: 'utf8' });
    assert.equal(compiled.stdout, '', options.join(' '));
  }
});

test('what a page loads has at most 3 MB when compressed', () => {
  const bytes = ['isocnc.wasm', 'isocnc.mjs', 'index.js', 'worker.js'].reduce((sum, name) => sum + gzipSync(readFileSync(join(made, 'dist', name))).length, 0);
  assert.ok(bytes < 3e6, `${bytes}`);
});

// What is in the package, and what is not.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';

const vsix = process.env.ISOCNC_VSIX;
const listing = `
import json, sys, zipfile
with zipfile.ZipFile(sys.argv[1]) as package:
    print(json.dumps({each.filename: [each.file_size, each.external_attr >> 16] for each in package.infolist()}))
`;
const files = JSON.parse(execFileSync('python3', ['-c', listing, vsix], { encoding: 'utf8' }));
const text = (name) => execFileSync('python3', ['-c', 'import sys, zipfile; sys.stdout.buffer.write(zipfile.ZipFile(sys.argv[1]).read(sys.argv[2]))', vsix, name], { encoding: 'utf8' });
const manifest = JSON.parse(text('extension/package.json'));

const isWeb = /-web-/.test(vsix);
const onlyNative = { skip: isWeb && 'it has no native programs' };

test('it is for this platform', () => {
  const platform = isWeb ? 'web' : `${process.platform}-${process.arch}`;
  assert.match(text('extension.vsixmanifest'), new RegExp(`TargetPlatform="${platform}"`));
});

test('the package for browsers has the module and no programs, the others have nothing for browsers', () => {
  for (const name of ['web/worker.js', 'web/isocnc.wasm', 'browser.js']) assert.equal(`extension/dist/${name}` in files, isWeb, name);
  assert.equal('browser' in manifest, isWeb);
  if (isWeb) assert.deepEqual(Object.keys(files).filter((name) => name.startsWith('extension/bin')), []);
});

test('the programs are in it, and may be started', onlyNative, () => {
  for (const name of ['isols', 'isolint', 'isorun', 'isofmt']) {
    const [size, mode] = files[`extension/bin/${name}`] ?? [];
    assert.ok(size > 100_000, `${name}: ${size} bytes`);
    assert.equal(mode & 0o111, 0o111, name);
  }
});

test('the programs need nothing of the system but the C library', { skip: onlyNative.skip || (process.platform !== 'linux' && 'this looks at programs of Linux') }, (context) => {
  const folder = mkdtempSync(join(tmpdir(), 'isocnc-package-'));
  context.after(() => rmSync(folder, { recursive: true }));
  execFileSync('python3', ['-c', 'import sys, zipfile; zipfile.ZipFile(sys.argv[1]).extractall(sys.argv[2])', vsix, folder]);
  const programs = Object.keys(files).filter((name) => name.startsWith('extension/bin/'));
  assert.ok(programs.length >= 4, programs.join());
  for (const name of programs) {
    const dynamic = execFileSync('readelf', ['--dynamic', '--wide', join(folder, name)], { encoding: 'utf8', env: { ...process.env, LC_ALL: 'C' } });
    const needed = [...dynamic.matchAll(/\(NEEDED\).*\[(.+)\]/g)].map(([, library]) => library);
    assert.ok(needed.length > 0, name);
    const others = needed.filter((library) => !/^(libc|libm|ld-linux[\w-]*)\.so/.test(library));
    assert.deepEqual(others, [], `${name}: link it with ISOCNC_STATIC=ON, as the release preset does`);
  }
});

test('whatever package.json names is in it', () => {
  const { contributes, main, browser, icon } = manifest;
  const named = [
    main,
    browser,
    icon,
    ...contributes.languages.flatMap(({ configuration, icon: icons }) => [configuration, icons?.light, icons?.dark]),
    ...contributes.grammars.map(({ path }) => path),
    ...contributes.snippets.map(({ path }) => path),
    ...contributes.jsonValidation.map(({ url }) => url),
    ...contributes.walkthroughs.flatMap(({ steps }) => steps.map(({ media }) => media.image ?? media.markdown)),
    'dist/toolpath.js', 'dist/toolpath.css', 'dist/toolpath.html', 'l10n/bundle.l10n.it.json', 'package.nls.it.json', 'test-drive/start-here.iso',
  ].filter(Boolean);
  for (const name of named) assert.ok(`extension/${name.replace(/^\.\//, '')}` in files, name);
  const pictures = [...text('extension/readme.md').matchAll(/!\[[^\]]*\]\(([^)]+)\)/g)].map(([, name]) => name);
  assert.ok(pictures.length > 0);
  for (const name of pictures) assert.ok(`extension/${name}` in files, name);
});

test('nothing else is in it', () => {
  const strange = Object.keys(files).filter((name) => /node_modules|\.ts$|\.map$|\.vscodeignore|tests?\/|package-lock/.test(name));
  assert.deepEqual(strange, []);
  for (const key of ['scripts', 'devDependencies', 'dependencies', 'private']) assert.ok(!(key in manifest), key);
});

test('it is small enough to be sent around', () => {
  const [, most] = /^\| `isocnc-PLATFORM-VERSION\.vsix` \| [^|]+ \| [^|]+ \| (\d+) MB \|/m.exec(readFileSync(new URL('../../docs/platforms.md', import.meta.url), 'utf8'));
  const megabytes = statSync(vsix).size / 1e6;
  assert.ok(megabytes < Number(most), `${megabytes} MB, at most ${most}`);
  for (const [name, maxSize] of [['dist/extension.js', 600_000], ['dist/browser.js', 600_000], ['dist/toolpath.js', 900_000]]) {
    const [size] = files[`extension/${name}`] ?? [0];
    assert.ok(size < maxSize, `${name}: ${size} bytes`);
  }
});

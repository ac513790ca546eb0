import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { extension, module } from '../modules.mjs';

const { findProgram } = await module('programs');
const { isOlder } = await module('versions');
const places = { configured: '', bundled: '/ext/bin', path: ['/usr/local/bin', '', '/usr/bin'] };
const having = (...files) => (file) => files.includes(file);

test('a program comes with the extension, else from the PATH', () => {
  assert.equal(findProgram('isols', places, having('/ext/bin/isols', '/usr/bin/isols')), '/ext/bin/isols');
  assert.equal(findProgram('isols', places, having('/usr/bin/isols')), '/usr/bin/isols');
  assert.equal(findProgram('isols', places, having('/usr/bin/isolint')), null);
});

test('what the user names is the only place', () => {
  const named = { ...places, configured: '/opt/cnc' };
  assert.equal(findProgram('isodap', named, having('/opt/cnc/isodap', '/ext/bin/isodap')), '/opt/cnc/isodap');
  assert.equal(findProgram('isodap', named, having('/ext/bin/isodap')), null);
});

test('a folder that is not trusted names no programs', () => {
  const { capabilities, contributes } = JSON.parse(readFileSync(join(extension, 'package.json'), 'utf8'));
  const { supported, restrictedConfigurations } = capabilities.untrustedWorkspaces;
  assert.equal(supported, 'limited');
  assert.ok('isocnc.path' in contributes.configuration.properties);
  assert.ok(restrictedConfigurations.includes('isocnc.path'));
});

test('programs have an ending on Windows', () => {
  assert.match(findProgram('isols', places, (file) => file.endsWith('isols.exe'), 'win32'), /bin.isols\.exe$/);
});

for (const [version, wanted, answer] of [
  ['0.1.0', '0.1.0', false],
  ['0.1.1', '0.1.0', false],
  ['1.0.0', '0.9.9', false],
  ['0.10.0', '0.9.0', false],
  ['0.9.0', '0.10.0', true],
  ['0.0.9', '0.1.0', true],
  ['0.1.0-pre', '0.1.0', false],
  [undefined, '0.1.0', true],
  ['new', '0.1.0', true],
])
  test(`${version} is ${answer ? '' : 'not '}older than ${wanted}`, () => assert.equal(isOlder(version, wanted), answer));

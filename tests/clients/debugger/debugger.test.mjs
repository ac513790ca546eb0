import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import test from 'node:test';
import { Client, asked, example, programs, root } from './client.mjs';

test('steps an example on and back', async () => {
  const client = await Client.start({ program: example('option.iso'), stopOnEntry: true, vgpl: 2 });
  await client.request('configurationDoneRequest');
  assert.equal((await client.event('stopped')).reason, 'entry');
  const seen = [];
  for (let i = 0; i < 10; ++i) {
    seen.push([await client.line(), await client.evaluate('X'), await client.evaluate('Z'), await client.evaluate('TIME,6')]);
    await client.run('nextRequest');
  }
  for (const state of seen.reverse()) {
    await client.run('stepBackRequest');
    assert.deepEqual(
      [await client.line(), await client.evaluate('X'), await client.evaluate('Z'), await client.evaluate('TIME,6')],
      state,
    );
  }
  assert.equal(await client.stop(), 0);
});

test('stops at breakpoints with conditions, and shows how it has come there', async () => {
  const client = await Client.start({ program: example('option.iso'), vgpl: 2 });
  const breakpoints = await client.setBreakpoints([
    { line: 29, condition: 'Z < 0 && S > 0' },
    { line: 36, condition: 'Z > 100' },
    { line: 1 },
  ]);
  assert.deepEqual(breakpoints.map(({ line, verified }) => [line, verified]), [[29, true], [36, true], [3, true]]);
  await client.request('configurationDoneRequest');
  assert.equal((await client.event('stopped')).reason, 'breakpoint');
  assert.equal(await client.line(), 3);
  await client.run('continueRequest');
  assert.deepEqual((await client.frames()).map(({ line }) => line), [29, 19]);
  const position = await client.variables('Position');
  assert.equal(position.get('Z'), '-8');
  assert.equal((await client.variables('Feed and spindle')).get('S'), '18000');
  assert.match((await client.variables('Modal groups')).get('motion'), /^G01 .*line/);
  // Where the motion was set is a link.
  const { scopes } = (await client.request('scopesRequest', { frameId: 1 })).body;
  const { variablesReference } = scopes.find(({ name }) => name === 'Modal groups');
  const { variables } = (await client.request('variablesRequest', { variablesReference })).body;
  const { valueLocationReference } = variables.find(({ name }) => name === 'motion');
  const set = (await client.custom('locations', { locationReference: valueLocationReference })).body;
  const shown = fs.readFileSync(set.source.path, 'utf8').split('\n')[set.line - 1];
  assert.match(shown.slice(set.column - 1, set.endColumn - 1), /^G0?1$/);
  await client.run('reverseContinueRequest');
  assert.equal(await client.line(), 3);
  assert.equal(await client.stop(), 0);
});

test('a program error is an exception that can be stepped back from', async () => {
  const client = await Client.start({ program: example('broken/option.iso'), vgpl: 2 });
  await client.request('setExceptionBreakpointsRequest', { filters: ['errors'] });
  await client.request('configurationDoneRequest');
  const stopped = await client.event('stopped');
  assert.equal(stopped.reason, 'exception');
  const info = (await client.request('exceptionInfoRequest', { threadId: 1 })).body;
  assert.equal(info.exceptionId, stopped.text);
  const line = await client.line();
  for (let i = 0; i < 3; ++i) await client.run('stepBackRequest');
  assert.ok((await client.line()) < line);
  assert.equal(await client.stop(), 0);
});

test('function, data and log breakpoints', async () => {
  const client = await Client.start({ program: example('option.iso'), vgpl: 1 });
  await client.request('setFunctionBreakpointsRequest', { breakpoints: [{ name: 'M06', hitCondition: '2' }] });
  const { dataId } = (await client.request('dataBreakpointInfoRequest', { name: 'Z = 0' })).body;
  await client.custom('setDataBreakpoints', { breakpoints: [{ dataId, hitCondition: '1' }] });
  await client.setBreakpoints([{ line: 9, logMessage: 'down to {Z}' }]);
  await client.request('configurationDoneRequest');
  assert.equal((await client.event('stopped')).reason, 'data breakpoint');
  assert.ok(await client.event('output', ({ output }) => output === 'down to 40\n'));
  await client.run('continueRequest');
  assert.equal(await client.line(), 24);
  assert.equal(await client.stop(), 0);
});

test('variables, expressions, the console and goto', async () => {
  const client = await Client.start({
    program: example('registers.iso'),
    stopOnEntry: true,
    initialize: { supportsInvalidatedEvent: true },
  });
  await client.request('configurationDoneRequest');
  await client.event('stopped');
  await client.custom('setExpression', { expression: 'V7', value: '2.5 * 4' });
  await client.event('invalidated');
  assert.equal(await client.evaluate('V7'), '10');
  assert.equal(await client.evaluate('V7,x'), '0xA');
  assert.match(await client.evaluate('M06 T101001', 'repl'), /T101001/);
  assert.match(await client.evaluate('G90', 'repl'), /G909/);
  assert.match(await client.evaluate('G00 Z77 G909', 'repl'), /ZM 77/);
  await client.run('stepBackRequest');
  assert.notEqual(await client.evaluate('Z'), '77');
  const { targets } = (await client.request('completionsRequest', { text: 'VG', column: 3 })).body;
  assert.deepEqual(targets.map(({ label }) => label), ['VGPL']);
  const goal = (await client.custom('gotoTargets', { source: { path: client.program }, line: 8 })).body.targets[0];
  assert.equal((await client.run('gotoRequest', { targetId: goal.id })).reason, 'goto');
  assert.equal(await client.line(), goal.line);
  assert.equal(await client.stop(), 0);
});

test('runs to the first difference from another program, forward and backward', async () => {
  const program = example('pocket.iso');
  const text = fs.readFileSync(program, 'utf8');
  const line = text.split('\n').findIndex((each) => each.includes('G01 Z-12 ')) + 1;
  const other = { text: text.replace('G01 Z-12 ', 'G01 Z-11.8 '), name: 'last.iso' };
  const client = await Client.start({ program, stopOnEntry: true });
  await client.request('configurationDoneRequest');
  await client.event('stopped');
  await client.custom('isocnc/runToDifference', other);
  const { reason, description } = await client.event('stopped');
  assert.deepEqual([reason, description], ['difference', `first difference: moved by Z-0.2, lines ${line}-${line + 11} of last.iso`]);
  assert.equal(await client.line(), line);
  await client.run('nextRequest');
  await client.custom('isocnc/runToDifference', other);
  await client.event('stopped');
  assert.equal(await client.line(), line);
  assert.equal(await client.stop(), 0);
});

test('keeps pace with the clock, tells where it is, and pauses', async () => {
  const client = await Client.start({ program: example('pocket.iso'), speed: 1 });
  await client.request('configurationDoneRequest');
  await client.event('isocnc/position', ({ running }) => running);
  const stopped = client.event('stopped');
  await client.request('pauseRequest', { threadId: 1 });
  assert.equal((await stopped).reason, 'pause');
  assert.equal(await client.stop(), 0);
});

test('restarts, runs to the end, and is over', async () => {
  const client = await Client.start({ program: example('drilling.iso'), stopOnEntry: true });
  await client.request('configurationDoneRequest');
  await client.event('stopped');
  await client.run('nextRequest');
  await client.custom('restart');
  assert.equal((await client.event('stopped')).reason, 'entry');
  await client.request('continueRequest', { threadId: 1 });
  assert.equal((await client.event('exited')).exitCode, 0);
  await client.event('terminated');
  assert.equal(await client.stop(), 0);
});

test('a client that dies ends the adapter', async () => {
  const client = await Client.start({ program: example('pocket.iso'), speed: 1 });
  await client.request('configurationDoneRequest');
  client.process.stdin.destroy();
  assert.equal(await client.exit, 1);
});

test('nonsense is told, and the next request understood', { skip: process.env.ISOCNC_HOSTED }, async () => {
  const client = await Client.start();
  client.process.stdin.write('Content-Length: 1\r\n\r\n{');
  client.process.stdin.write('Content-Length: nonsense\r\n\r\n');
  await client.event('output', ({ category }) => category === 'stderr');
  await assert.rejects(client.custom('fly'));
  assert.equal(await client.stop(), 0);
});

test('every example runs to the end that isorun comes to, and steps back from it', async () => {
  for (const folder of ['', 'broken'])
    for (const name of fs.readdirSync(path.join(root, 'examples', folder)).filter((file) => file.endsWith('.iso'))) {
      const program = example(path.join(folder, name));
      const isorun = spawnSync(path.join(programs, 'isorun'), ['--lang', 'en', '--json', program], { encoding: 'utf8' });
      const client = await Client.start({ program });
      await client.setBreakpoints([{ line: 1e6 - 1 }]);
      await client.request('configurationDoneRequest');
      if (isorun.status === 0) {
        assert.equal((await client.event('exited')).exitCode, 0, name);
      } else {
        const stopped = await client.event('stopped');
        assert.equal(stopped.reason, 'exception', name);
        assert.ok((isorun.stdout + isorun.stderr).includes(stopped.text), `${name}: ${stopped.text}`);
        const line = await client.line();
        await client.run('stepBackRequest');
        assert.equal(await client.line(), line, name);
        await client.run('reverseContinueRequest');
        assert.equal(await client.evaluate('TIME'), '0', name);
      }
      assert.equal(await client.stop(), 0);
    }
});

test('steps into the segments of an arc in G49, and out of the section', async () => {
  const client = await Client.start({ program: example('five-axis.iso') });
  await client.setBreakpoints([{ line: 16 }]);
  await client.request('configurationDoneRequest');
  await client.event('stopped');
  await client.run('stepInRequest');
  const names = [];
  for (let i = 0; i < 3; ++i) {
    names.push((await client.frames())[0].name);
    await client.run('stepInRequest');
  }
  assert.deepEqual(names.map((name) => name.replace(/ of \d+$/, '')), ['segment 1', 'segment 2', 'segment 3']);
  assert.notEqual((await client.variables('Position')).get('Distance to go'), '0 mm');
  await client.run('stepBackRequest', { granularity: 'instruction' });
  assert.match((await client.frames())[0].name, /^segment 3 /);
  await client.run('stepBackRequest');
  assert.equal(await client.line(), 16);
  assert.equal((await client.frames()).length, 1);
  assert.equal(await client.stop(), 0);

  const faces = await Client.start({ program: example('five-faces.iso') });
  await faces.setBreakpoints([{ line: 23 }]);
  await faces.request('configurationDoneRequest');
  await faces.event('stopped');
  await faces.run('stepOutRequest');
  assert.equal(await faces.line(), 30, 'where the face frame has gone');
  assert.equal(await faces.stop(), 0);
});

test('threads, sources and places for breakpoints', async () => {
  const program = example('option.iso');
  const client = await Client.start({ program, stopOnEntry: true });
  await client.request('configurationDoneRequest');
  await client.event('stopped');
  assert.equal((await client.request('threadsRequest')).body.threads.length, 1);
  assert.deepEqual((await client.custom('loadedSources')).body.sources.map((source) => source.path), [program]);
  assert.equal((await client.request('sourceRequest', { source: { path: program }, sourceReference: 0 })).body.content, fs.readFileSync(program, 'utf8'));
  const { breakpoints } = (await client.custom('breakpointLocations', { source: { path: program }, line: 1, endLine: 4 })).body;
  assert.deepEqual(breakpoints.map(({ line }) => line), [3, 4]);
  await client.custom('cancel', { requestId: 1 });
  assert.equal(await client.stop(), 0);
});

test('sets variables, and answers the mouse', async () => {
  const client = await Client.start({ program: example('registers.iso'), stopOnEntry: true, registers: { V5: 40 } });
  await client.request('configurationDoneRequest');
  await client.event('stopped');
  const { scopes } = (await client.request('scopesRequest', { frameId: 1 })).body;
  const set = async (scope, name, value) => {
    const { variablesReference } = scopes.find((each) => each.name === scope);
    return (await client.request('setVariableRequest', { variablesReference, name, value })).body.value;
  };
  assert.equal(await set('Registers', 'V6', '1'), '1');
  assert.equal(await set('Feed and spindle', 'OVERRIDE', '50'), '50');
  assert.equal(await set('Feed and spindle', 'F', '1200'), '1200');
  assert.equal(await set('Feed and spindle', 'S', '9000'), '9000');
  assert.equal(await set('GPL variables', 'Var_IF[1]', '34.567'), '34.567');
  assert.equal(await client.evaluate('V5', 'hover'), '40');
  assert.equal(await client.evaluate('VGPL', 'watch'), '34.567');
  await assert.rejects(set('Times', 'TIME', '0'));
  // V5 skips the hole, V6 asks for the trimming.
  await client.setBreakpoints([{ line: 25 }, { line: 41 }]);
  await client.run('continueRequest');
  assert.equal(await client.line(), 25);
  await client.request('continueRequest', { threadId: 1 });
  assert.equal((await client.event('exited')).exitCode, 0);
  assert.equal(await client.stop(), 0);
});

test('exceptions: tool changes, first cuts, warnings and axis limits', async () => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'isodap-'));
  const program = path.join(folder, 'limits.iso');
  fs.writeFileSync(program, 'M06 T101001\nG17\nG17\nG00 X10 Z5\nG01 Z-1 F500\nX900\nM02\n');
  fs.writeFileSync(path.join(folder, 'isocnc.json'), '{"machine": {"axes": {"X": {"min": 0, "max": 500}}}}');
  const client = await Client.start({ program });
  const filters = client.capabilities.exceptionBreakpointFilters.map(({ filter }) => filter);
  await client.request('setExceptionBreakpointsRequest', { filters });
  await client.request('configurationDoneRequest');
  const seen = [];
  const see = async (stopped) => {
    const info = (await client.request('exceptionInfoRequest', { threadId: 1 })).body;
    assert.equal(info.exceptionId, stopped.text);
    seen.push([await client.line(), stopped.text]);
  };
  await see(await client.event('stopped'));
  await see(await client.run('continueRequest'));
  await see(await client.run('continueRequest'));
  // The checker warns of the same move, and so do a run and the limits.
  await client.request('setExceptionBreakpointsRequest', { filters: filters.filter((filter) => filter !== 'warnings') });
  await see(await client.run('continueRequest'));
  assert.deepEqual(seen, [[1, 'toolChange'], [3, 'W001'], [5, 'firstCut'], [6, 'E160']]);
  await client.run('reverseContinueRequest');
  assert.equal(await client.line(), 5);
  assert.equal(await client.stop(), 0);
  fs.rmSync(folder, { recursive: true });
});

test('a program that changes on disk is debugged as it was, and restarted as it is', async () => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'isodap-'));
  const program = path.join(folder, 'changing.iso');
  const text = fs.readFileSync(example('drilling.iso'), 'utf8');
  fs.writeFileSync(program, text);
  const client = await Client.start({ program, stopOnEntry: true });
  await client.request('configurationDoneRequest');
  const entry = (await client.event('stopped')) && (await client.line());
  fs.writeFileSync(program, `; one line more\n${text}`);
  await client.run('nextRequest');
  assert.equal((await client.event('loadedSource')).reason, 'changed');
  assert.equal((await client.request('sourceRequest', { source: { path: program }, sourceReference: 0 })).body.content, text);
  fs.rmSync(program);
  await assert.rejects(client.custom('restart'), /drilling|changing/);
  await client.run('nextRequest');
  fs.writeFileSync(program, `; one line more\n${text}`);
  await client.custom('restart', { arguments: { program, stopOnEntry: true } });
  await client.event('stopped', ({ reason }) => reason === 'entry');
  assert.equal(await client.line(), entry + 1);
  assert.equal(await client.stop(), 0);
  fs.rmSync(folder, { recursive: true });
});

test('runs without debugging, starts and restarts at a block, and is terminated', async () => {
  const program = example('option.iso');
  const plain = await Client.start({ program, vgpl: 2, noDebug: true, stopOnEntry: true });
  await plain.request('configurationDoneRequest');
  assert.equal((await plain.event('exited')).exitCode, 0);
  assert.equal(await plain.stop(), 0);

  const client = await Client.start({ program, vgpl: 2, startAtLine: 29 });
  await client.request('configurationDoneRequest');
  await client.event('stopped');
  assert.equal(await client.line(), 29);
  const state = await client.variables('Position');
  await client.custom('restart', { arguments: { program, vgpl: 2, stopOnEntry: true } });
  await client.event('stopped');
  while ((await client.line()) < 29) await client.run('nextRequest');
  assert.deepEqual(await client.variables('Position'), state);
  await client.custom('restart', { arguments: { program, vgpl: 2, startAtLine: 29 } });
  await client.event('stopped');
  assert.equal(await client.line(), 29);
  await client.request('terminateRequest');
  await client.event('terminated');
  assert.equal(await client.stop(), 0);
});

test('a client that is killed leaves no adapter behind', async () => {
  const script = `
    import { Client, example } from '${path.join(root, 'tests/clients/debugger/client.mjs')}';
    const client = await Client.start({ program: example('pocket.iso'), speed: 1 });
    await client.request('configurationDoneRequest');
    await client.event('isocnc/position');
    console.log(client.process.pid);
    process.kill(process.pid, 'SIGKILL');
  `;
  const killed = spawnSync(process.execPath, ['--input-type=module', '-e', script], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });
  assert.equal(killed.signal, 'SIGKILL');
  const pid = Number(killed.stdout);
  assert.ok(pid > 0);
  const isThere = () => fs.existsSync(`/proc/${pid}`) && !/^State:\s+Z/m.test(fs.readFileSync(`/proc/${pid}/status`, 'utf8'));
  for (let i = 0; i < 100 && isThere(); ++i) await new Promise((resolve) => setTimeout(resolve, 50));
  assert.ok(!isThere());
});

test('every request has been made', () => {
  const folder = path.join(root, 'debugger/requests');
  const commands = fs.readdirSync(folder)
    .filter((file) => file.endsWith('.cpp') && file !== 'request.cpp')
    .map((file) => fs.readFileSync(path.join(folder, file), 'utf8').match(/\bon<&\w+>\(\s*"([\w/]+)"/)?.[1] ?? file);
  assert.deepEqual(commands.filter((command) => !asked.has(command)), []);
});

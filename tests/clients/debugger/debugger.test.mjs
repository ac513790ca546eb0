import assert from 'node:assert/strict';
import test from 'node:test';
import { Client, example } from './client.mjs';

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

test('nonsense is told, and the next request understood', async () => {
  const client = await Client.start();
  client.process.stdin.write('Content-Length: 1\r\n\r\n{');
  client.process.stdin.write('Content-Length: nonsense\r\n\r\n');
  await client.event('output', ({ category }) => category === 'stderr');
  await assert.rejects(client.custom('fly'));
  assert.equal(await client.stop(), 0);
});

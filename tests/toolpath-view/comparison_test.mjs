// Two programs at once: their lines beside each other, what has become of each, and one clock for both paths, held against closed forms.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { packed, recordingOf, viewModule } from './run.mjs';

const { Toolpath } = await viewModule('toolpath');
const { Comparison, markOf } = await viewModule('comparison');

const home = { home: [0, 0, 0, 0, 0], tools: [{ name: null, length: null, radius: null }], frames: [], travel: [], turnsTool: true };
const feed = (line, seconds, ...points) => ({ line, kind: 1, tool: 0, seconds: seconds / points.length, points: points.map(([x, y, z = 0, b = 0, c = 0]) => [x, y, z, b, c]) });
const change = (kind, old, now) => ({ kind, old, new: now, tool: null, distance: null, text: { en: kind, it: kind } });

/** `lines`: triples of old lines, new lines, repeats. */
function compared(oldMoves, newMoves, lines, changes = []) {
  const paths = { old: new Toolpath(recordingOf(home, oldMoves)), new: new Toolpath(recordingOf(home, newMoves)) };
  const time = (path) => ({ time: path.seconds });
  const facts = { same: changes.length === 0, old: time(paths.old), new: time(paths.new), changes };
  return new Comparison(paths, { facts, alignment: Uint8Array.from(lines.flat().flatMap(packed)) });
}
const near = (one, other, what) => assert.ok(Math.abs(one - other) < 1e-8, `${what ?? ''} ${one} instead of ${other}`);

test('rows have the lines that stand beside each other, and gaps', () => {
  const both = compared([feed(1, 1, [1, 0])], [feed(1, 1, [1, 0])], [[1, 1, 2], [0, 2, 1], [2, 0, 1], [1, 3, 1]]);
  assert.equal(both.rowCount, 2 + 2 + 2 + 3);
  const rows = Array.from({ length: both.rowCount }, (_, i) => both.row(i)).map((row) => [row.old, row.new]);
  assert.deepEqual(rows, [[0, 0], [1, 1], [-1, 2], [-1, 3], [2, -1], [3, -1], [4, 4], [-1, 5], [-1, 6]]);
  assert.deepEqual([both.lineCount('old'), both.lineCount('new')], [5, 7]);
  rows.forEach(([old, now], row) => {
    if (old >= 0) assert.equal(both.rowOf('old', old), row);
    if (now >= 0) assert.equal(both.rowOf('new', now), row);
  });
  assert.equal(both.rowOf('new', 99), -1);
});

test('a line belongs to the shortest change that has it', () => {
  const both = compared(
    [feed(1, 1, [1, 0])],
    [feed(1, 1, [1, 0])],
    [[1, 1, 6]],
    [change('moved', [2, 3], [2, 4]), change('feed', [1, 5], [1, 5]), change('removed', [6, 6], null)],
  );
  assert.deepEqual([0, 1, 2, 3, 4, 5].map((line) => both.mark('old', line)), ['changed', 'moved', 'moved', 'changed', 'changed', 'removed']);
  assert.deepEqual([0, 1, 2, 3, 4, 5].map((line) => both.mark('new', line)), ['changed', 'moved', 'moved', 'moved', 'changed', 'same']);
  assert.equal(both.changeOf('old', 5), 2);
  assert.equal(both.changeOf('new', 5), -1);
  for (const [kind, mark] of [['frame', 'moved'], ['added', 'added'], ['shape', 'changed'], ['end', 'changed']]) assert.equal(markOf({ kind }), mark);
});

test('where motions are missing, the next line takes another path', () => {
  const moves = [feed(1, 1, [1, 0])];
  const both = compared(moves, moves, [[1, 1, 4]], [change('removed', [2, 3], [2, 2]), change('added', [4, 4], [3, 4])]);
  assert.deepEqual([0, 1, 2, 3].map((line) => both.mark('old', line)), ['same', 'removed', 'removed', 'changed']);
  assert.deepEqual([0, 1, 2, 3].map((line) => both.mark('new', line)), ['same', 'changed', 'added', 'added']);
});

test('with another feed, both tools are at the same place at the same moment', () => {
  // 100 mm in 1 s and then 100 mm in 1 s; now in 4 s and in 1 s.
  const both = compared([feed(1, 1, [100, 0]), feed(2, 1, [200, 0])], [feed(1, 4, [100, 0]), feed(2, 1, [200, 0])], [[1, 1, 2]]);
  const { clock, paths } = both;
  near(clock.seconds, 5);
  for (let now = 0; now <= 5; now += 0.125) {
    near(clock.time('new', now), now);
    near(clock.time('old', now), now <= 4 ? now / 4 : now - 3);
    assert.ok(Math.abs(paths.old.at(clock.time('old', now)).tip[0] - paths.new.at(now).tip[0]) < 2e-6); // 10 ns at 100 mm/s.
    near(clock.at('new', clock.time('new', now)), now);
    near(clock.at('old', clock.time('old', now)), now);
  }
});

test('the way decides, not the time: a tool that speeds up is beside one that does not', () => {
  // Both go 100 mm in 2 s; the old one in two halves, of 1.5 s and of 0.5 s.
  const both = compared([{ ...feed(1, 0, [50, 0]), seconds: 1.5 }, { ...feed(2, 0, [100, 0]), seconds: 0.5 }], [feed(1, 2, [100, 0])], [[2, 1, 1]]);
  for (const [clock, old] of [[0, 0], [0.5, 0.75], [1, 1.5], [1.5, 1.75], [2, 2]]) near(both.clock.time('old', clock), old);
});

test('what only one program does takes its time, and the other one waits', () => {
  // Old: A 1 s, B 3 s, C 1 s. New: A 1 s, D 2 s, C 1 s, with D behind B.
  const both = compared(
    [feed(1, 1, [10, 0]), feed(2, 3, [10, 30]), feed(3, 1, [20, 0])],
    [feed(1, 1, [10, 0]), feed(2, 2, [10, -20]), feed(3, 1, [20, 0])],
    [[1, 1, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]],
    [change('removed', [2, 2], null), change('added', null, [2, 2])],
  );
  const { clock } = both;
  near(clock.seconds, 1 + 3 + 2 + 1);
  for (const [now, old, recent] of [[0.5, 0.5, 0.5], [1, 1, 1], [2.5, 2.5, 1], [4, 4, 1], [5, 4, 2], [6, 4, 3], [6.5, 4.5, 3.5], [7, 5, 4], [99, 5, 4]]) {
    near(clock.time('old', now), old, `old at ${now}:`);
    near(clock.time('new', now), recent, `new at ${now}:`);
  }
  // The first moment at which a program has come so far.
  near(clock.at('new', 1), 1);
  near(clock.at('new', 3), 6);
  near(clock.at('old', 4), 4);
  near(clock.at('old', 4.25), 6.25);
  // A change is seen when its first move is done.
  near(both.momentOf(0), 4);
  near(both.momentOf(1), 6);
  assert.deepEqual(both.stepsOf('old', 0), { start: 1, end: 2 });
  assert.equal(both.stepsOf('new', 0), null);
});

test('the end of a step is no moment of the next one', () => {
  const moves = Array.from({ length: 50 }, (_, i) => feed(i + 1, 0.1 + i / 7, [i + 1, 0]));
  const slower = Array.from({ length: 50 }, (_, i) => feed(i + 1, 0.3 + i / 11, [i + 1, 0]));
  for (const lines of [[[1, 1, 50]], [[50, 50, 1]], [[1, 0, 50], [0, 1, 50]]]) {
    const { clock, paths } = compared(moves, slower, lines);
    for (const side of ['old', 'new'])
      for (let step = 0; step < 50; ++step) assert.equal(paths[side].at(clock.time(side, clock.at(side, paths[side].endOf(step)))).step, step);
  }
});

test('steps of either path follow each other', () => {
  const { clock } = compared([feed(1, 1, [10, 0]), feed(2, 3, [10, 30]), feed(3, 1, [20, 0])], [feed(1, 1, [10, 0]), feed(2, 2, [10, -20]), feed(3, 1, [20, 0])], [[1, 1, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]]);
  const moments = [];
  for (let moment = 0; moment < clock.seconds; ) moments.push((moment = clock.neighbor(moment, 1)));
  assert.deepEqual(moments, [1, 4, 6, 7]);
  for (let moment = 6.5; moment > 0; ) moments.push((moment = clock.neighbor(moment, -1)));
  assert.deepEqual(moments.slice(4), [6, 4, 1, 0]);
  near(clock.neighbor(7, 1), 7);
});

test('turns of B and C alone are a way, too', () => {
  const turn = (seconds, ...c) => ({ line: 1, kind: 1, tool: 0, seconds, points: c.map((each) => [0, 0, 0, 0, each]) });
  const both = compared([turn(1, 90)], [turn(2, 45, 90)], [[1, 1, 1]]);
  for (const [now, old] of [[1, 0.25], [2, 0.5], [3, 0.75], [4, 1]]) near(both.clock.time('old', now), old);
});

test('where one of them only waits, its time goes on evenly', () => {
  const wait = { line: 1, kind: 3, tool: 0, seconds: 2, points: [[0, 0, 0, 0, 0]] };
  const both = compared([wait], [{ ...wait, seconds: 4 }], [[1, 1, 1]]);
  near(both.clock.time('old', 1), 0.5);
  near(both.clock.seconds, 4);
});

test('steps of one line go one by one where both have the same', () => {
  // A wait and a move on one line; by the way alone, the old tool would not wait.
  const line = (waits, moves) => [
    { line: 1, kind: 3, tool: 0, seconds: waits, points: [[0, 0, 0, 0, 0]] },
    { line: 1, kind: 1, tool: 0, seconds: moves, points: [[10, 0, 0, 0, 0]] },
  ];
  const both = compared(line(2, 1), line(4, 1), [[1, 1, 1]]);
  near(both.clock.time('old', 2), 1);
  near(both.clock.time('old', 4.5), 2.5);
});

test('programs that do nothing have a clock that stands', () => {
  const both = compared([], [], [[1, 0, 1]]);
  near(both.clock.seconds, 0);
  near(both.clock.time('old', 1), 0);
  near(both.clock.at('new', 1), 0);
  const empty = compared([], [], []);
  assert.equal(empty.rowCount, 0);
});

test('times go on evenly through random programs, and the clock finds its moments again', () => {
  let seed = 7;
  const random = (n) => (seed = (seed * 48271) % 0x7fffffff) % n;
  for (let round = 0; round < 200; ++round) {
    const moves = { old: [], new: [] };
    const lines = [];
    let [old, now] = [1, 1];
    for (let i = 0; i < 12; ++i) {
      const entry = [random(3), random(3), 1];
      for (let k = 0; k < entry[0]; ++k) moves.old.push(feed(old++, random(4), [random(9), random(9)]));
      for (let k = 0; k < entry[1]; ++k) moves.new.push(feed(now++, random(4), [random(9), random(9)]));
      if (entry[0] + entry[1] > 0) lines.push(entry);
    }
    const { clock, paths } = compared(moves.old, moves.new, lines);
    let last = { old: 0, new: 0 };
    for (let moment = 0; moment <= clock.seconds; moment += 0.25) {
      const times = { old: clock.time('old', moment), new: clock.time('new', moment) };
      for (const side of ['old', 'new']) {
        assert.ok(times[side] >= last[side] - 1e-8, `${side} goes back at ${moment} in round ${round}`);
        const again = clock.at(side, times[side]);
        near(clock.time(side, again), times[side], `round ${round}, ${side}:`);
        if (side === 'new') assert.ok(again <= moment + 1e-9);
      }
      last = times;
    }
    for (const side of ['old', 'new']) near(clock.time(side, clock.seconds), paths[side].stepCount > 0 ? paths[side].seconds : 0, `round ${round}, ${side}:`);
  }
});

// The stock over time: read as it is written, and the same by every way to a moment.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { viewModule } from './run.mjs';
import { encoded, numbers, randomCuts, stateAfter, stockFacts } from './stock.mjs';

const { StockTimeline } = await viewModule('stock_timeline');
const { removedBy } = await viewModule('stock');

const shown = ({ dexels }) =>
  Array.from({ length: dexels.count }, (_, i) => `${dexels.lines[i]}: ${dexels.materialOf(i)}`);
const wanted = (state) => state.map(({ material, line }) => `${line}: ${material.flat()}`);

test('pictures and moments are read as they are written', () => {
  const timeline = new StockTimeline(
    stockFacts(3, 2, { hasTarget: true }),
    encoded({
      blank: [[5, [[10_000, -2000]]], [1, []]],
      target: [[1, []], [5, [[9000, 5000], [4000, -2000]]]],
      moments: [
        { time: 1, groups: [{ line: 4, runs: [{ first: 1, length: 2, all: [[7000, -2000]] }] }] },
        { time: 1.5, groups: [{ line: 9, runs: [{ first: 0, each: [[], [[6000, 3000], [2000, -2000]]] }] }, { line: 2, runs: [{ first: 4, length: 1, all: [[9999, -2000]] }] }] },
      ],
    }),
  );
  const blank = ['10000,-2000', '10000,-2000', '10000,-2000', '10000,-2000', '10000,-2000', ''].map((each) => `-1: ${each}`);
  timeline.goTo(0.99999999);
  assert.deepEqual(shown(timeline), blank);
  timeline.goTo(1);
  assert.deepEqual(shown(timeline), [blank[0], '4: 7000,-2000', '4: 7000,-2000', blank[3], blank[4], blank[5]]);
  timeline.goTo(1e9);
  assert.deepEqual(shown(timeline), ['9: ', '9: 6000,3000,2000,-2000', '4: 7000,-2000', blank[3], '2: 9999,-2000', blank[5]]);
  assert.deepEqual(timeline.target.materialOf(5), [9000, 5000, 4000, -2000]);
  assert.deepEqual(timeline.target.materialOf(0), []);
  assert.equal(timeline.greatestDepth, 4000);
  assert.deepEqual([...timeline.momentTimes], [1, 1.5]);
});

test('intervals that touch are one, and those without a length none', () => {
  const timeline = new StockTimeline(
    stockFacts(2, 1),
    encoded({ blank: [[1, [[9, 5], [5, 2], [1, 1]]], [1, [[7, 7]]]], moments: [] }),
  );
  assert.deepEqual([timeline.dexels.materialOf(0), timeline.dexels.materialOf(1)], [[9, 2], []]);
});

for (const seed of [1, 2, 3])
  test(`every way to a moment ends in the same stock (${seed})`, () => {
    const [columns, rows, count] = [60, 40, 300];
    const cuts = randomCuts(seed, columns, rows, count);
    const timeline = new StockTimeline(stockFacts(columns, rows), encoded(cuts));
    assert.equal(timeline.momentCount, count);
    const random = numbers(seed + 100);
    let at = 0;
    let changed = new Set();
    timeline.onChange = (first, length) => {
      for (let i = first; i < first + length; ++i) changed.add(i);
    };
    timeline.goToMoment(0);
    let before = shown(timeline);
    for (let walk = 0; walk < 150; ++walk) {
      at = [Math.min(at + 1, count), Math.max(at - 1, 0), Math.max(at - 7, 0), random(count + 1)][random(4)];
      changed = new Set();
      timeline.goToMoment(at);
      const now = shown(timeline);
      assert.deepEqual(now, wanted(stateAfter(cuts, at)), `after ${at} moments`);
      now.forEach((each, i) => assert.ok(each === before[i] || changed.has(i), `dexel ${i} has changed unsaid`));
      before = now;
    }
  });

test('at a time all moments up to it have been applied', () => {
  const cuts = randomCuts(5, 20, 20, 80);
  const timeline = new StockTimeline(stockFacts(20, 20), encoded(cuts));
  const random = numbers(6);
  for (let i = 0; i < 100; ++i) {
    const { time } = cuts.moments[random(80)];
    const shift = [-1e-7, 0, 1e-7][random(3)];
    timeline.goTo(time + shift);
    const count = cuts.moments.filter((moment) => moment.time <= time + shift + 1e-9).length;
    assert.deepEqual(shown(timeline), wanted(stateAfter(cuts, count)));
  }
});

/** A table of a million dexels, cut in 4000 moments: rows of 1000, again and again, each a little deeper. */
function table() {
  const [columns, rows, count] = [1000, 1000, 4000];
  const moments = Array.from({ length: count }, (_, i) => ({
    time: (i + 1) / 10,
    groups: [{ line: i, runs: [{ first: ((i * 3) % rows) * columns, length: columns, all: [[20_000 - i, 0]] }] }],
  }));
  return new StockTimeline(stockFacts(columns, rows), encoded({ blank: [[columns * rows, [[20_000, 0]]]], moments }));
}

test('a step touches only its dexels, and a jump few enough', () => {
  const timeline = table();
  const random = numbers(9);
  timeline.goToMoment(2170);
  for (const [to, work] of [[2171, 1000], [2170, 1000], [2169, 1000], [2170, 1000]]) {
    timeline.goToMoment(to);
    assert.equal(timeline.work, work, `to ${to}`);
  }
  let longest = 0;
  for (let i = 0; i < 60; ++i) {
    const to = random(4001);
    const start = performance.now();
    timeline.goToMoment(to);
    longest = Math.max(longest, performance.now() - start);
    assert.ok(timeline.work <= 151_000, `${timeline.work} dexels`);
  }
  console.log(`longest jump: ${longest.toFixed(1)} ms`);
});

test('a damaged stream is refused', () => {
  const facts = stockFacts(4, 4);
  const whole = encoded(randomCuts(3, 4, 4, 5));
  for (const bytes of [new Uint8Array(), whole.slice(0, 1), Uint8Array.of(17, 1, 2, 2), Uint8Array.of(0, 0, 0), Uint8Array.of(16, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x0f, 0)])
    assert.throws(() => new StockTimeline(facts, bytes), RangeError);
  assert.throws(() => new StockTimeline({ ...facts, columns: 1e9 }, whole), RangeError);
  const random = numbers(4);
  for (let i = 0; i < 300; ++i) {
    const broken = whole.map((byte) => (random(20) === 0 ? random(256) : byte));
    try {
      new StockTimeline(facts, broken);
    } catch (problem) {
      assert.ok(problem instanceof RangeError, String(problem));
    }
  }
});

test('what a line has removed is found by its line', () => {
  const facts = stockFacts(1, 1, { removed: [{ line: 3, volume: 5, depth: 1, width: 2 }, { line: 8, volume: 6, depth: 2, width: 3 }] });
  assert.equal(removedBy(facts, 8).volume, 6);
  for (const line of [-1, 0, 4, 9]) assert.equal(removedBy(facts, line), null);
});

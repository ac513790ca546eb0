import assert from 'node:assert/strict';
import { test } from 'node:test';
import { viewModule } from '../modules.mjs';

const { applied, patched, received, whole } = await viewModule('streams');
const bytes = (...values) => Uint8Array.from(values);

/** How one stream differs from another, as isols reports it. */
function difference(old, now) {
  const shared = Math.min(old.length, now.length);
  let start = 0;
  while (start < shared && old[start] === now[start]) ++start;
  let tail = 0;
  while (tail < shared - start && old.at(-1 - tail) === now.at(-1 - tail)) ++tail;
  return { start, removed: old.length - start - tail, data: now.slice(start, now.length - tail) };
}

/** Reproducible. */
function* numbers(seed) {
  for (let state = seed; ; ) yield (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) >>> 8;
}

test('a patch makes the new stream of the old one', () => {
  const random = numbers(7);
  const upTo = (limit) => random.next().value % limit;
  const stream = () => Uint8Array.from({ length: upTo(12) }, () => upTo(3));
  for (let i = 0; i < 2000; ++i) {
    const [old, now] = [stream(), stream()];
    assert.deepEqual(patched(old, difference(old, now)), now, `${old} -> ${now}`);
  }
});

test('without a start it is the whole stream', () => {
  assert.deepEqual(patched(bytes(1, 2), { data: bytes(3) }), bytes(3));
  assert.deepEqual(patched(undefined, { data: bytes() }), bytes());
});

test('a patch of another stream is refused', () => {
  assert.throws(() => patched(bytes(1, 2), { start: 1, removed: 2, data: bytes() }), RangeError);
  assert.throws(() => patched(undefined, { start: 0, removed: 0, data: bytes(1) }), RangeError);
});

test('a recording goes there and back', () => {
  const facts = { version: 1 };
  const recording = { facts, steps: bytes(1), points: bytes(2, 3), turns: bytes() };
  assert.deepEqual(applied(null, facts, whole(recording)), recording);
});

test('a stock may come with a path, change with it, and go', () => {
  const facts = { version: 1 };
  const bare = { facts, steps: bytes(1), points: bytes(2, 3), turns: bytes() };
  const cut = { ...bare, cuts: bytes(4, 5, 6) };
  const same = whole(bare);
  assert.deepEqual(applied(null, facts, whole(cut)), cut);
  assert.deepEqual(applied(bare, facts, { ...same, cuts: { data: bytes(4, 5, 6) } }), cut);
  assert.deepEqual(applied(bare, facts, { ...same, cuts: { start: 0, removed: 0, data: bytes(4) } }).cuts, bytes(4));
  assert.deepEqual(applied(cut, facts, { ...same, cuts: { start: 1, removed: 1, data: bytes(9) } }).cuts, bytes(4, 9, 6));
  assert.deepEqual(applied(cut, facts, same), bare);
  const sent = { steps: { data: 'AQ==' }, points: { data: 'AgM=' }, turns: { data: '' }, cuts: { start: 1, removed: 0, data: 'CQ==' } };
  const decoded = received(sent, (base64) => new Uint8Array(Buffer.from(base64, 'base64')));
  assert.deepEqual(decoded.cuts, { start: 1, removed: 0, data: bytes(9) });
  assert.equal('cuts' in received({ ...sent, cuts: undefined }, () => bytes()), false);
});

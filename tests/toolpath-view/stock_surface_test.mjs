// The surface of the stock: closed, as large as the material, smooth where it is; and what an update of the picture costs, in counts.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { viewModule } from './run.mjs';
import { numbers, stockFacts } from './stock.mjs';

const { Dexels } = await viewModule('stock');
const { SurfaceBuilder, tileSize, maxLevel } = await viewModule('stock_surface');
const { StockTiles, budget } = await viewModule('stock_tiles');

const colors = { top: () => 0x808080, wall: () => 0x808080, other: 0x808080 };

/** Dexels with the material that a function gives for a column and a row. */
function dexelsOf(columns, rows, materialAt) {
  const dexels = new Dexels(columns, rows);
  for (let dexel = 0; dexel < dexels.count; ++dexel) {
    const [first, ...more] = materialAt(dexel % columns, Math.floor(dexel / columns));
    if (first) dexels.set(dexel, first[0], first[1], more.length > 0 ? Int32Array.from(more.flat()) : null);
  }
  return dexels;
}

/** The volume that triangles enclose, and the sum of their areas as vectors, which is 0 where they are closed. */
function measured(surfaces) {
  let volume = 0;
  const sum = [0, 0, 0];
  for (const { positions, indices } of surfaces)
    for (let i = 0; i < indices.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => positions.slice(3 * indices[i + k], 3 * indices[i + k] + 3));
      const cross = [0, 1, 2].map((k) => {
        const [y, z] = [(k + 1) % 3, (k + 2) % 3];
        return (b[y] - a[y]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[y] - a[y]);
      });
      volume += (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6;
      cross.forEach((value, k) => (sum[k] += value / 2));
    }
  return { volume, sum };
}

function surfacesOf(dexels, level = 0, facts = stockFacts(dexels.columns, dexels.rows)) {
  const builder = new SurfaceBuilder(dexels, facts);
  const surfaces = [];
  for (let row = 0; row * tileSize < dexels.rows; ++row)
    for (let column = 0; column * tileSize < dexels.columns; ++column) surfaces.push(builder.build(column, row, level, colors));
  return surfaces;
}

for (const [name, materialAt] of [
  ['a block', () => [[10_000, 0]]],
  ['a pocket in a corner of tiles', (x, y) => (x > 50 && x < 80 && y > 60 && y < 70 ? [[4000, 0]] : [[10_000, 0]])],
  ['steps, holes and undercuts', (x, y) => [[], [[40_000, 30_000], [20_000, 10_000], [5000, -5000]], [[20_000, 0]], [[60_000, 50_000], [30_000, 0]]][(x * 7 + y * y) % 4]],
])
  test(`${name}: the surface is closed and holds the volume of the dexels`, () => {
    const dexels = dexelsOf(90, 75, materialAt);
    const { volume, sum } = measured(surfacesOf(dexels));
    let wanted = 0;
    for (let dexel = 0; dexel < dexels.count; ++dexel) {
      const material = dexels.materialOf(dexel);
      for (let i = 0; i < material.length; i += 2) wanted += (material[i] - material[i + 1]) / 1000;
    }
    assert.ok(Math.abs(volume - wanted) < 1e-4 * wanted, `${volume}, not ${wanted}`);
    for (const each of sum) assert.ok(Math.abs(each) < 1e-6 * wanted, `${sum}`);
  });

for (let level = 1; level <= maxLevel; ++level)
  test(`level ${level}: a block stays what it is, and a narrow slot is seen`, () => {
    assert.ok(Math.abs(measured(surfacesOf(dexelsOf(128, 64, () => [[10_000, 0]]), level)).volume - 128 * 64 * 10) < 1);
    const { volume } = measured(surfacesOf(dexelsOf(128, 64, (x) => [[x === 33 ? 2000 : 10_000, 0]]), level));
    assert.ok(Math.abs(volume - (128 * 64 * 10 - 2 ** level * 64 * 8)) < 1, `${volume}`);
  });

test('a hollow of a ball looks like one, and the edge of a pocket stays sharp', () => {
  const [radius, spacing] = [40, 0.5];
  const facts = stockFacts(200, 200, { spacing: [spacing, spacing], first: [0, 0] });
  const off = (column, row) => [(column - 100) * spacing, (row - 100) * spacing];
  const height = (x, y) => Math.round(1000 * (radius - Math.sqrt(radius ** 2 - x * x - y * y)));
  const dexels = dexelsOf(200, 200, (column, row) => [[Math.min(20_000, Math.hypot(...off(column, row)) < 34 ? height(...off(column, row)) : 20_000), -1000]]);
  let [count, worst] = [0, 0];
  for (const { positions, normals } of surfacesOf(dexels, 0, facts))
    for (let corner = 0; corner < positions.length / 3; ++corner) {
      const [x, y, z] = [positions[3 * corner] - 50, positions[3 * corner + 1] - 50, positions[3 * corner + 2]];
      if (Math.hypot(x, y) > 30 || z < 0) continue;
      // The normal of a hollow points to its center.
      const wanted = [-x / radius, -y / radius, (radius - z) / radius];
      const cosine = wanted.reduce((sum, value, k) => sum + (value * normals[4 * corner + k]) / 32767, 0) / Math.hypot(...wanted);
      worst = Math.max(worst, (Math.acos(Math.min(1, cosine)) * 180) / Math.PI);
      ++count;
    }
  assert.ok(count > 10_000);
  assert.ok(worst < 3, `${worst} degrees`);
  const step = dexelsOf(20, 20, (x) => [[x < 10 ? 10_000 : 9300, 0]]);
  for (const { positions, normals } of surfacesOf(step))
    for (let corner = 0; corner < positions.length / 3; ++corner) {
      assert.ok([0, 9.3, 10].some((z) => Math.abs(positions[3 * corner + 2] - z) < 1e-5));
      assert.equal([0, 1, 2].filter((k) => Math.abs(normals[4 * corner + k]) === 32767).length, 1);
    }
});

test('a chamfer is a slope from its first dexel on, and no stairs', () => {
  const chamfer = dexelsOf(20, 20, (x) => [[x < 10 ? 10_000 : 10_000 - 700 * (x - 9), -10_000]]);
  for (const { positions, normals } of surfacesOf(chamfer))
    for (let corner = 0; corner < positions.length / 3; ++corner) {
      const isInside = [0, 1].every((k) => positions[3 * corner + k] > 0.5 && positions[3 * corner + k] < 19.5);
      if (isInside) assert.notEqual(normals[4 * corner + 2], 0, `a wall at X${positions[3 * corner]}`);
    }
});

/** Tiles of dexels, with what has been drawn of each. */
function tilesOf(dexels) {
  const builder = new SurfaceBuilder(dexels, stockFacts(dexels.columns, dexels.rows));
  const drawn = [];
  const tiles = new StockTiles(dexels.columns, dexels.rows, ({ column, row }, level) => builder.build(column, row, level, colors), (tile) => drawn.push(tile));
  return { tiles, drawn };
}
const everywhere = (level) => ({ level, isSeen: () => true });

/** Updates until nothing is left; each within the budget. */
function settle(tiles, sight) {
  for (let updates = 1; ; ++updates) {
    const update = tiles.update(sight);
    assert.ok(update.triangles <= budget.triangles && update.bytes <= budget.bytes, JSON.stringify(update));
    assert.ok(tiles.triangles <= budget.total);
    if (!update.isMore) return updates;
    assert.ok(updates < 200);
  }
}

const random = numbers(3);
for (const [name, side, materialAt] of [
  ['a smooth surface', 1000, (x, y) => [[Math.round(20_000 + 5000 * Math.sin(x / 30) * Math.cos(y / 25)), 0]]],
  ['noise', 1000, () => [[10_000 + random(30_000), random(5000)]]],
  ['undercuts everywhere', 400, () => [[50_000 + random(9000), 40_000], [30_000, 20_000 + random(5000)], [10_000, 0]]],
])
  test(`${side} x ${side} dexels, ${name}: few triangles, and few at once`, () => {
    const { tiles } = tilesOf(dexelsOf(side, side, materialAt));
    settle(tiles, everywhere(0));
    assert.equal(tiles.tiles.filter(({ isChanged }) => isChanged).length, 0);
    assert.ok(tiles.tiles.every(({ triangles }) => triangles > 0), 'a tile is left out');
  });

test('only tiles with changes are made anew, and those that look into them', () => {
  const dexels = dexelsOf(640, 640, () => [[10_000, 0]]);
  const { tiles, drawn } = tilesOf(dexels);
  settle(tiles, everywhere(0));
  assert.equal(drawn.length, 100);
  const names = () => drawn.splice(0).map(({ column, row }) => `${column} ${row}`).sort();
  names();
  assert.equal(tiles.update(everywhere(0)).tiles, 0);
  tiles.change(100 * 640 + 100, 5);
  settle(tiles, everywhere(0));
  assert.deepEqual(names(), ['1 1']);
  tiles.change(100 * 640 + 126, 2);
  settle(tiles, everywhere(0));
  assert.deepEqual(names(), ['1 1', '2 1']);
  // From row to row.
  tiles.change(200 * 640 + 630, 20);
  settle(tiles, everywhere(0));
  assert.deepEqual(names(), ['0 3', '9 3']);
});

test('who comes near sees more, and tiles out of sight wait', () => {
  const dexels = dexelsOf(640, 640, (x, y) => [[Math.round(20_000 + 5000 * Math.sin((x + y) / 30)), 0]]);
  const { tiles, drawn } = tilesOf(dexels);
  settle(tiles, everywhere(3));
  const coarse = tiles.triangles;
  const isSeen = ({ column, row }) => column < 3 && row < 3;
  drawn.length = 0;
  settle(tiles, { level: 0, isSeen });
  assert.equal(drawn.length, 9);
  assert.ok(tiles.triangles > coarse);
  tiles.changeAll();
  drawn.length = 0;
  settle(tiles, { level: 0, isSeen });
  assert.equal(drawn.length, 9);
  settle(tiles, everywhere(0));
  assert.equal(drawn.length, 100);
});

// Rays, sections, colors and files of the stock, in closed form.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { recordingOf, viewModule } from './run.mjs';
import { encoded, numbers, panel, stockFacts } from './stock.mjs';

const { StockTimeline } = await viewModule('stock_timeline');
const { hitStock } = await viewModule('stock_ray');
const { sectionFaces } = await viewModule('stock_section');
const { stlOf } = await viewModule('stock_stl');
const { deviationAt, stockColors } = await viewModule('stock_colors');
const { palettes } = await viewModule('colors');
const { removedVolume, volumeText } = await viewModule('stock_legend');
const { Toolpath } = await viewModule('toolpath');

/** Dexels with the material of a function, and the lines that have cut them, from 0; -1 is none. */
function timelineOf(columns, rows, materialAt, lineAt = () => -1, facts = {}) {
  const blank = [];
  const runs = [];
  for (let dexel = 0; dexel < columns * rows; ++dexel) {
    const [column, row] = [dexel % columns, Math.floor(dexel / columns)];
    blank.push([1, materialAt(column, row)]);
    if (lineAt(column, row) >= 0) runs.push({ line: lineAt(column, row), runs: [{ first: dexel, length: 1, all: materialAt(column, row) }] });
  }
  return new StockTimeline(stockFacts(columns, rows, facts), encoded({ blank, moments: runs.length > 0 ? [{ time: 1, groups: runs }] : [] }));
}
const hit = ({ dexels, facts }, origin, direction, section) => hitStock(dexels, facts, origin, direction, section);
const down = [0, 0, -1];

test('a ray from above hits the top, with the line that has cut it', () => {
  const timeline = timelineOf(10, 10, (x) => [[x < 5 ? 4000 : 10_000, 0]], (x) => (x < 5 ? 7 : -1));
  const cut = hit(timeline, [2.3, 3.7, 50], down);
  assert.deepEqual([cut.at, cut.face, cut.line, cut.dexel], [[2.3, 3.7, 4], 'top', 7, 32]);
  assert.equal(hit(timeline, [7, 3, 50], down).line, -1);
  assert.equal(hit(timeline, [-1, 3, 50], down), null);
  assert.equal(hit(timeline, [2, 3, -5], [0, 0, 1]).face, 'bottom');
});

test('a wall belongs to the line that has cut what is beside it', () => {
  const timeline = timelineOf(10, 10, (x) => [[x < 5 ? 4000 : 10_000, 0]], (x) => (x < 5 ? 7 : -1));
  const wall = hit(timeline, [-20, 4.5, 8], [1, 0, 0]);
  assert.deepEqual([wall.at, wall.face, wall.line], [[5, 4.5, 8], 'side', 7]);
  assert.equal(hit(timeline, [30, 4.5, 8], [-1, 0, 0]).line, -1);
});

test('a ray goes through holes, and under what overhangs', () => {
  const timeline = timelineOf(4, 1, (x) => [[], [[9000, 6000], [3000, 0]], [[9000, 6000], [3000, 0]], [[9000, 0]]][x]);
  assert.equal(hit(timeline, [0.5, 0.5, 20], down), null);
  const floor = hit(timeline, [-1, 0.5, 5.5], [1, 0, -1]);
  assert.ok(Math.abs(floor.at[2] - 3) < 1e-9 && floor.face === 'top');
  assert.ok(Math.abs(hit(timeline, [-1, 0.5, 4], [1, 0, 0]).at[0] - 3) < 1e-9);
  assert.equal(hit(timeline, [-1, 0.5, 3.6], [1, 0, 1]).face, 'bottom');
});

test('rays find what a search in small steps finds', () => {
  const random = numbers(11);
  const timeline = timelineOf(12, 9, () => [[], [[5000, 0]], [[9000, 7000], [4000, 1000]], [[8000, 2000]]][random(4)]);
  const { dexels } = timeline;
  const isSolid = ([x, y, z]) => x >= 0 && y >= 0 && x < 12 && y < 9 && dexels.isSolid(Math.floor(y) * 12 + Math.floor(x), 1000 * z);
  for (let i = 0; i < 300; ++i) {
    const origin = [random(1200) / 100, random(900) / 100, 30];
    const aim = [random(1200) / 100 + 0.001, random(900) / 100 + 0.001, random(900) / 100];
    const length = Math.hypot(...aim.map((value, k) => value - origin[k]));
    const direction = aim.map((value, k) => (value - origin[k]) / length);
    const section = random(2) ? { axis: random(3), at: 4.2, keeps: random(2) ? 1 : -1 } : null;
    const keeps = (at) => !section || section.keeps * (at[section.axis] - section.at) >= 0;
    let wanted = null;
    for (let distance = 15; distance < 60 && wanted === null; distance += 0.004) {
      const at = origin.map((value, k) => value + distance * direction[k]);
      if (keeps(at) && isSolid(at)) wanted = distance;
    }
    const found = hit(timeline, origin, direction, section);
    // A ray may graze less than a step of the search.
    if (found && (wanted === null || found.distance < wanted - 0.005)) {
      const inside = origin.map((value, k) => value + (found.distance + 1e-6) * direction[k]);
      assert.ok(isSolid(inside) && keeps(inside), `${origin} ${direction}`);
    } else assert.ok(wanted === null ? found === null : Math.abs(found.distance - wanted) < 0.005, `${found?.distance} ${wanted}`);
  }
});

const areaOf = ({ positions, indices }) => {
  let area = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => positions.slice(3 * indices[i + k], 3 * indices[i + k] + 3));
    const [u, v] = [b.map((value, k) => value - a[k]), c.map((value, k) => value - a[k])];
    area += Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
  }
  return area;
};

test('a section is filled where there is material, and nowhere else', () => {
  const { dexels, facts } = timelineOf(20, 10, (x, y) => (x === 3 ? [] : x === 7 ? [[40_000, 30_000], [10_000, 0]] : [[y < 5 ? 40_000 : 10_000, 0]]));
  const area = (axis, at) => areaOf(sectionFaces(dexels, facts, { axis, at, keeps: 1 }));
  assert.equal(area(0, 3.5), 0);
  assert.equal(area(0, 10.5), 5 * 40 + 5 * 10);
  assert.equal(area(0, 7.5), 10 * 20);
  assert.equal(area(1, 2.5), 18 * 40 + 20);
  assert.equal(area(1, 8.5), 18 * 10 + 20);
  assert.equal(area(2, 5), 190);
  assert.equal(area(2, 20), 18 * 5);
  assert.equal(area(2, 35), 18 * 5 + 10);
  assert.equal(area(2, 50), 0);
  assert.equal(area(0, -5), 0);
});

test('a level section of a million dexels stays small', () => {
  const random = numbers(2);
  const { dexels, facts } = timelineOf(1000, 1000, () => [[random(2) ? 9000 : 1000, 0]]);
  assert.ok(sectionFaces(dexels, facts, { axis: 2, at: 5, keeps: -1 }).indices.length / 3 <= 40_000);
});

/** The triangles of a binary STL file. */
function read(parts) {
  const bytes = Buffer.concat(parts);
  const count = bytes.readUInt32LE(80);
  assert.equal(bytes.length, 84 + 50 * count);
  assert.notEqual(bytes.subarray(0, 5).toString(), 'solid');
  return Array.from({ length: count }, (_, i) =>
    [0, 1, 2, 3].map((corner) => [0, 1, 2].map((k) => bytes.readFloatLE(84 + 50 * i + 12 * corner + 4 * k))));
}

for (const [name, materialAt] of [
  ['a block', () => [[10_000, 0]]],
  ['a pocket', (x, y) => [[x > 3 && x < 20 && y > 5 && y < 9 ? 4000 : 10_000, 0]]],
  ['steps, holes and undercuts', (() => {
    const random = numbers(21);
    return () => [[], [[9000, 7000], [4000, 1000]], [[8000, 2000]], [[9000, 0]], [[7000, 6500], [6000, 5000], [2000, 0]]][random(5)];
  })()],
])
  test(`STL of ${name}: closed, with the volume of the dexels, and its faces look outside`, () => {
    const { dexels, facts } = timelineOf(30, 22, materialAt, undefined, { spacing: [0.5, 0.25], first: [100, -3] });
    const edges = new Map();
    let volume = 0;
    for (const [normal, ...corners] of read(stlOf(dexels, facts))) {
      const [a, b, c] = corners;
      const cross = [0, 1, 2].map((k) => {
        const [y, z] = [(k + 1) % 3, (k + 2) % 3];
        return (b[y] - a[y]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[y] - a[y]);
      });
      const size = Math.hypot(...cross);
      assert.ok(size > 1e-9, 'a triangle without an area');
      cross.forEach((value, k) => assert.ok(Math.abs(value / size - normal[k]) < 1e-6));
      volume += (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6;
      corners.forEach((corner, k) => {
        const next = corners[(k + 1) % 3];
        edges.set(`${corner} ${next}`, (edges.get(`${corner} ${next}`) ?? 0) + 1);
        edges.set(`${next} ${corner}`, (edges.get(`${next} ${corner}`) ?? 0) - 1);
      });
    }
    for (const [edge, count] of edges) assert.equal(count, 0, `the edge ${edge} is open`);
    let wanted = 0;
    for (let dexel = 0; dexel < dexels.count; ++dexel) {
      const material = dexels.materialOf(dexel);
      for (let i = 0; i < material.length; i += 2) wanted += ((material[i] - material[i + 1]) / 1000) * 0.5 * 0.25;
    }
    assert.ok(Math.abs(volume - wanted) < 1e-3 * wanted, `${volume}, not ${wanted}`);
  });

const path = new Toolpath({ ...recordingOf(panel.facts, panel.moves), cuts: panel.cuts });
const stock = new StockTimeline(panel.facts.stock, panel.cuts);
stock.goTo(1e9);
const at = (x, y) => Math.floor(y) * 200 + Math.floor(x);

test('the deviation from the part is that of its heights nearby', () => {
  const { target } = stock;
  assert.equal(deviationAt(target, at(50, 40), 8000), -1000);
  assert.equal(deviationAt(target, at(50, 80), 8000), 0);
  assert.equal(deviationAt(target, at(50, 20), 14_000), 2000);
  // Between two heights of the part, a wall is right at any height.
  for (const height of [8000, 12_000, 18_000]) assert.equal(deviationAt(target, at(98.5, 80), height), 0);
  for (const place of [at(97.5, 80), at(50, 97.5), at(50, 98.5), at(11.5, 40), at(12.5, 80)]) assert.equal(deviationAt(target, place, 12_000), 0, `dexel ${place}`);
  assert.equal(deviationAt(target, at(98.5, 80), 18_400), 400);
  assert.equal(deviationAt(target, at(120, 50), 1000), Infinity);
});

test('each mode colors what it is about, and what is not cut is neutral', () => {
  const number = ([r, g, b]) => (r << 16) | (g << 8) | b;
  for (const theme of Object.keys(palettes)) {
    const colorsOf = (mode) => stockColors(stock, path, mode, theme, (color) => color).top;
    const neutral = number(palettes[theme].bodies.stock);
    for (const mode of ['tool', 'operation', 'deviation', 'depth']) assert.equal(colorsOf(mode)(at(195, 5)), neutral);
    const tool = colorsOf('tool');
    assert.equal(tool(at(50, 20)), tool(at(50, 80)));
    assert.notEqual(tool(at(50, 20)), tool(at(160, 60)));
    const { left, within, gouged } = palettes[theme].deviation;
    const deviation = colorsOf('deviation');
    assert.deepEqual([at(50, 20), at(50, 80), at(50, 40), at(160, 60)].map(deviation), [left, within, gouged, within].map(number));
    const depth = colorsOf('depth');
    assert.notEqual(depth(at(50, 20)), depth(at(50, 80)));
    assert.equal(depth(at(50, 80)), number(palettes[theme].depth.at(-1)));
  }
});

test('a side has the color of what has been cut beside it', () => {
  const colors = stockColors(stock, path, 'tool', 'light', (color) => color);
  assert.equal(colors.wall(at(99.5, 80), at(97.5, 80)), colors.top(at(97.5, 80)));
  assert.equal(colors.wall(at(199.5, 5), -1), colors.top(at(195, 5)));
});

test('volumes are those of the run, or of lines', () => {
  assert.equal(removedVolume(panel.facts.stock, null), 99_388);
  assert.equal(removedVolume(panel.facts.stock, { first: 3, last: 4 }), 6016);
  assert.deepEqual([0, 12.34, 12_440, 1_250_000].map(volumeText), ['0 mm³', '12.3 mm³', '12.4 cm³', '1250 cm³']);
});

// Colors of kinds of moves: seen on their background, and no two kinds of moves alike.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { viewModule } from './run.mjs';

/** What WCAG asks of graphics is 3; the gray of rapids on the light page has a little less. */
const minimumContrast = 2.9;

const { palettes } = await viewModule('colors');

/** Relative luminance, as WCAG defines it. */
function luminance(color) {
  const [r, g, b] = color.map((each) => (each / 255 <= 0.04045 ? each / 255 / 12.92 : ((each / 255 + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
function contrast(a, b) {
  const [dark, light] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (light + 0.05) / (dark + 0.05);
}

for (const [theme, { background, bodies, contacts, measure }] of Object.entries(palettes))
  test(`${theme}: marks of contacts and measurements are seen, and bodies differ by their role`, () => {
    for (const color of [...Object.values(contacts), measure])
      assert.ok(contrast(color, background) >= minimumContrast, `${color}: ${contrast(color, background)}`);
    assert.equal(new Set(Object.values(bodies).map(String)).size, 5);
  });

for (const [theme, { background, kinds }] of Object.entries(palettes))
  test(`${theme}: each kind of move is seen on the background, and differs from the others`, () => {
    for (const kind of kinds) assert.ok(contrast(kind, background) >= minimumContrast, `${kind}: ${contrast(kind, background)}`);
    assert.equal(new Set(kinds.map(String)).size, kinds.length);
  });

for (const [theme, { deviation, depth }] of Object.entries(palettes))
  test(`${theme}: deviations and depths of the stock differ by lightness, not by hue alone`, () => {
    const { left, within, gouged } = deviation;
    // Green between blue and red must not be mistaken for either by those who see no green or no red.
    for (const color of [left, gouged]) assert.ok(contrast(within, color) >= 2, `${color}: ${contrast(within, color)}`);
    // Blue and red differ for all; the stronger of the two in blue is the one that is left.
    assert.ok(left[2] > left[0] + 60 && gouged[0] > gouged[2] + 60);
    const lightness = depth.map(luminance);
    for (let i = 1; i < depth.length; ++i) assert.ok(lightness[i] < lightness[i - 1], 'deeper is darker');
    assert.ok(contrast(depth[0], depth.at(-1)) >= 4);
  });

/** What is seen without red, green or blue cones: Machado, Oliveira and Fernandes 2009, on linear light. */
const kindsOfVision = {
  all: [1, 0, 0, 0, 1, 0, 0, 0, 1],
  protanopia: [0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998],
  deuteranopia: [0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.01182, 0.04294, 0.968881],
  tritanopia: [1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.3039],
};

/** CIE L*a*b* of a color as it is seen. */
function seen(color, m) {
  const linear = color.map((each) => (each / 255 <= 0.04045 ? each / 255 / 12.92 : ((each / 255 + 0.055) / 1.055) ** 2.4));
  const [r, g, b] = [0, 3, 6].map((row) => Math.min(1, Math.max(0, m[row] * linear[0] + m[row + 1] * linear[1] + m[row + 2] * linear[2])));
  const [x, y, z] = [(0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.95047, 0.2126 * r + 0.7152 * g + 0.0722 * b, (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.08883].map((t) =>
    t > 0.008856 ? Math.cbrt(t) : 7.787 * t + 16 / 116,
  );
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

for (const [theme, { background, neutral, marks }] of Object.entries(palettes))
  test(`${theme}: what has become of a path is told apart with every kind of color vision`, () => {
    const colors = { same: neutral, ...marks };
    for (const color of Object.values(marks)) assert.ok(contrast(color, background) >= minimumContrast, `${color}: ${contrast(color, background)}`);
    for (const [vision, matrix] of Object.entries(kindsOfVision))
      for (const [one, first] of Object.entries(colors))
        for (const [other, second] of Object.entries(colors)) {
          if (one >= other) continue;
          const [a, b] = [seen(first, matrix), seen(second, matrix)];
          const distance = Math.hypot(...a.map((value, i) => value - b[i]));
          // Removed paths are dotted besides, and lists have signs.
          assert.ok(distance >= 25, `${one} and ${other} with ${vision}: ${distance.toFixed(1)}`);
        }
  });

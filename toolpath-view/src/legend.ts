/** What the colors mean. */
import { marks, markOf, type Comparison } from './comparison';
import { css, feedRange, markColor, palettes, toolColor, type Color, type Mode, type Theme } from './colors';
import { element, svg } from './elements';
import { clock, feed as shownFeed } from './format';
import type { Texts } from './texts';
import type { Toolpath } from './toolpath';

/** A short piece of line: dashed for rapids, dotted for the path of an old program. */
function sample(color: Color, dashes: 'none' | 'dashed' | 'dotted'): SVGElement {
  const pattern = { none: 'none', dashed: '5 3', dotted: '2.5 2' }[dashes];
  const stroke = { stroke: css(color), 'stroke-width': dashes === 'dashed' ? '1.5' : '2.4', 'stroke-dasharray': pattern };
  return svg('svg', { width: '28', height: '10', 'aria-hidden': 'true' }, svg('path', { d: 'M1 5h26', ...stroke }));
}

function entry(color: Color, text: string, isDashed = false): HTMLElement {
  return element('div', { className: 'entry' }, sample(color, isDashed ? 'dashed' : 'none'), text);
}

export function scale(stops: Color[], min: string, max: string): HTMLElement[] {
  const bar = element('div', { className: 'scale' });
  bar.style.background = `linear-gradient(to right, ${stops.map(css).join(', ')})`;
  return [bar, element('div', { className: 'ends' }, element('span', {}, min), element('span', {}, max))];
}

/** What has become of a path: dotted is how it was. */
function changeLegend(comparison: Comparison, theme: Theme, texts: Texts): HTMLElement[] {
  const found = new Set(comparison.changes.map(markOf));
  const neutral = palettes[theme].neutral;
  const texted = { same: texts.markSame, moved: texts.markMoved, added: texts.markAdded, removed: texts.markRemoved, changed: texts.markChanged };
  const entries = marks.filter((mark) => mark === 'same' || found.has(mark)).map((mark) => {
    const color = markColor(theme, mark);
    return element('div', { className: 'entry' }, sample(color, mark === 'removed' ? 'dotted' : 'none'), texted[mark]);
  });
  return [...entries, element('div', { className: 'entry' }, sample(neutral, 'dotted'), texts.dottedOld)];
}

export function legend(path: Toolpath, mode: Mode, theme: Theme, texts: Texts, comparison: Comparison | null = null): HTMLElement[] {
  const palette = palettes[theme];
  if (mode === 'change') return comparison ? changeLegend(comparison, theme, texts) : [];
  const dashed = entry(palette.neutral, texts.rapid, true);
  switch (mode) {
    case 'tool': {
      const used = new Set(path.stepTool);
      const entries = path.facts.tools.flatMap((tool, i) =>
        used.has(i) ? [entry(toolColor(theme, i), tool.name ?? texts.noTool)] : [],
      );
      return [...entries, dashed];
    }
    case 'kind':
      return [
        entry(palette.kinds[0], texts.rapid, true),
        entry(palette.kinds[1], texts.feedMove),
        entry(palette.kinds[2], texts.arc),
      ];
    case 'feed': {
      const range = feedRange(path);
      const noFeed = entry(palette.kinds[0], texts.noFeed, true);
      if (!range) return [noFeed];
      return [...scale(palette.feed, shownFeed(range.min), `${shownFeed(range.max)} ${texts.unit}`), noFeed];
    }
    case 'time':
      return [...scale(palette.time, clock(0), clock(path.seconds)), dashed];
  }
}

/** What the colors of the stock mean, and what its figures are called. */
import { css, palettes, type Color, type Theme } from './colors';
import { element, svg } from './elements';
import { sectionsOf } from './filter';
import { scale } from './legend';
import type { StockFacts } from './stock';
import { surfaceColor, type StockMode } from './stock_colors';
import type { StockTimeline } from './stock_timeline';
import type { Texts } from './texts';
import type { Toolpath } from './toolpath';

function entry(color: Color, text: string): HTMLElement {
  const square = svg('path', { d: 'M8 0h12v10H8z', fill: css(color) });
  return element('div', { className: 'entry' }, svg('svg', { width: '28', height: '10', 'aria-hidden': 'true' }, square), text);
}

export function stockLegend(timeline: StockTimeline, path: Toolpath, mode: StockMode, theme: Theme, texts: Texts): HTMLElement[] {
  const { bodies, deviation, depth } = palettes[theme];
  const rest = entry(bodies.stock, texts.uncutStock);
  const { facts } = timeline;
  switch (mode) {
    case 'tool': {
      const cutting = new Set(facts.removed.map(({ line }) => path.stepTool[path.stepsOf(line).start]));
      return [...path.facts.tools.flatMap(({ name }, i) => (cutting.has(i) ? [entry(surfaceColor(theme, i), name ?? texts.noTool)] : [])), rest];
    }
    case 'operation':
      return [
        ...sectionsOf(path).flatMap(({ start, end, tool }, i) => {
          const [first, last] = [path.stepLine[start], path.stepLine[end - 1]];
          if (!facts.removed.some(({ line }) => line >= first && line <= last)) return [];
          const text = `${texts.lines} ${first + 1}–${last + 1}: ${path.facts.tools[tool].name ?? texts.noTool}`;
          return [entry(surfaceColor(theme, i + 1), text)];
        }),
        rest,
      ];
    case 'deviation': {
      const tolerance = `${Number(facts.tolerance.toFixed(3))} mm`;
      return [
        entry(deviation.left, texts.leftOnPart.replace('{}', tolerance)),
        entry(deviation.within, texts.withinTolerance.replace('{}', tolerance)),
        entry(deviation.gouged, texts.gouged.replace('{}', tolerance)),
        rest,
      ];
    }
    case 'depth':
      return [...scale(depth, '0', `${(timeline.greatestDepth / 1000).toFixed(1)} mm`), rest];
  }
}

/** mm3 as cm3, but for what is tiny. */
export function volumeText(volume: number): string {
  if (Math.abs(volume) < 100) return `${volume.toFixed(volume === 0 ? 0 : 1)} mm³`;
  const cubicCentimeters = volume / 1000;
  return `${cubicCentimeters.toFixed(cubicCentimeters < 100 ? 1 : 0)} cm³`;
}

/** What lines remove together, or all of the program. */
export function removedVolume({ removed, volume, blankVolume }: StockFacts, lines: { first: number; last: number } | null): number {
  if (!lines) return blankVolume - volume;
  return removed.reduce((sum, each) => (each.line >= lines.first && each.line <= lines.last ? sum + each.volume : sum), 0);
}

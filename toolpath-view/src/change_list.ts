/** What two programs do differently, as a list under the picture and as ticks on the bar of the time. */
import { markOf, signs, type Change, type Comparison, type Side } from './comparison';
import { byId, element } from './elements';
import { texts as textsIn, type Language, type Texts } from './texts';
import { VirtualList } from './virtual_list';

const rowHeight = 26;
/** Ticks nearer to each other than this part of the bar become one. */
const tickPart = 1 / 400;

export class ChangeList {
  /** Somebody chose a change. */
  onChoose: (change: number) => void = () => {};
  private comparison: Comparison | null = null;
  private language: Language = 'en';
  private current = -1;
  private readonly list = new VirtualList(byId('change-list'), rowHeight, (change) => this.element(change));

  constructor() {
    byId('change-list').addEventListener('click', (event) => {
      const entry = (event.target as Element).closest<HTMLElement>('.change');
      if (entry) this.onChoose(Number(entry.dataset.change));
    });
    byId('change-list').addEventListener('keydown', (event) => {
      const direction = { ArrowUp: -1, ArrowDown: 1 }[event.key];
      if (!direction || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      const next = this.current + direction;
      if (next >= 0 && next < (this.comparison?.changes.length ?? 0)) this.onChoose(next);
    });
  }

  write(comparison: Comparison | null, language: Language): void {
    this.comparison = comparison;
    this.language = language;
    const texts = textsIn[language];
    const count = comparison?.changes.length ?? 0;
    byId('changes').hidden = comparison === null;
    byId('changes-title').textContent = count === 0 ? texts.noDifference : count === 1 ? texts.oneDifference : texts.differences.replace('{}', String(count));
    byId('change-list').hidden = count === 0;
    // As tall as its entries, up to what the style allows.
    byId('change-list').style.height = `${count * rowHeight + 6}px`;
    for (const id of ['change-previous', 'change-next']) byId(id).hidden = count === 0;
    this.list.take(count);
    if (comparison) byId('ticks').replaceChildren(...this.ticks(comparison));
  }

  /** Marks the change that is shown; -1 is none. */
  show(change: number): void {
    if (change === this.current) return;
    this.current = change;
    this.list.reveal(change);
    this.list.invalidate();
  }

  private element(index: number): HTMLElement {
    const change = this.comparison!.changes[index];
    const texts = textsIn[this.language];
    const mark = markOf(change);
    const entry = element(
      'div',
      { id: `change-${index + 1}`, className: 'change', title: texts.closerChange },
      element('span', { className: 'sign' }, signs[mark]),
      element('span', { className: 'message' }, change.text[this.language]),
      element('span', { className: 'place' }, placeOf(change, texts)),
    );
    entry.dataset.change = String(index);
    entry.dataset.mark = mark;
    entry.setAttribute('role', 'option');
    entry.setAttribute('aria-selected', String(index === this.current));
    return entry;
  }

  private ticks(comparison: Comparison): HTMLElement[] {
    const places = new Map<number, string>();
    comparison.changes.forEach((change, i) => {
      const { seconds } = comparison.clock;
      const place = seconds > 0 ? Math.round(comparison.momentOf(i) / seconds / tickPart) : 0;
      if (!places.has(place)) places.set(place, markOf(change));
    });
    return [...places].map(([place, mark]) => {
      const tick = element('span');
      tick.dataset.mark = mark;
      tick.style.left = `${100 * place * tickPart}%`;
      return tick;
    });
  }
}

/** `T101001, old 4-6, new 4-7` */
function placeOf(change: Change, texts: Texts): string {
  const range = (side: Side) => {
    const lines = change[side];
    return lines && (lines[0] === lines[1] ? String(lines[0]) : `${lines[0]}–${lines[1]}`);
  };
  const [old, now] = [range('old'), range('new')];
  const isOne = change.new && change.new[0] === change.new[1];
  const beside = [old && texts.oldLines.replace('{}', old), now && texts.newLines.replace('{}', now)].filter(Boolean).join(', ');
  const lines = old === now ? `${isOne ? texts.line : texts.lines} ${now}` : beside;
  return change.tool ? `${change.tool}, ${lines}` : lines;
}

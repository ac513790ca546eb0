/** Measuring: the places that somebody chooses one after another, and what is said of them. */
import { byId, element } from './elements';
import { coordinate } from './format';
import { measured, type Snap } from './measuring';
import type { SceneBody } from './scene';
import type { Texts } from './texts';
import type { Vector } from './toolpath';
import type { ToolpathView } from './toolpath_view';

export class MeasureTool {
  isActive = false;
  onChange: () => void = () => {};
  private chosen: Snap[] = [];
  /** What would be chosen next. */
  private next: Snap | null = null;
  /** Places that are offered one after another by keys, and which of them is. */
  private offered: Snap[] = [];
  private at = -1;

  constructor(
    private readonly view: ToolpathView,
    /** Where the tip of the tool is. */
    private readonly tip: () => Snap,
  ) {
    view.onSnap = (snap) => {
      if (snap) this.choose(snap);
    };
    view.onHover = (snap) => {
      this.next = snap;
      this.update();
    };
  }

  toggle(): void {
    if (this.isActive) return this.end();
    this.isActive = true;
    this.restart();
    this.view.startMeasuring();
    byId('stage').focus();
    this.onChange();
  }

  end(): void {
    if (!this.isActive) return;
    this.isActive = false;
    this.chosen = [];
    this.view.endMeasuring();
    this.onChange();
  }

  /** Forgets the places: the path is another one. */
  restart(): void {
    this.chosen = [];
    this.next = null;
    this.offered = [];
    this.at = -1;
    if (this.isActive) this.update();
  }

  /** Offers the next place of a body or center of an arc, or the one before, starting near the tip of the tool. */
  offer(direction: 1 | -1): void {
    if (this.offered.length === 0) this.offered = this.view.snapsNear(this.tip().at);
    if (this.offered.length === 0) return;
    this.at = (Math.max(this.at, direction > 0 ? -1 : 0) + direction + this.offered.length) % this.offered.length;
    this.next = this.offered[this.at];
    this.update();
  }

  /** Chooses what is offered, else where the tip of the tool is. */
  accept(): void {
    this.choose(this.next ?? this.tip());
  }

  private choose(snap: Snap): void {
    this.chosen = this.chosen.length === 2 ? [snap] : [...this.chosen, snap];
    this.next = null;
    // Offered anew, bodies may have moved.
    this.offered = [];
    this.at = -1;
    this.update();
  }

  private update(): void {
    this.view.showMeasurement(this.chosen.map(({ at }) => at), this.next?.at ?? null);
    this.onChange();
  }

  write(texts: Texts): void {
    const output = byId('measurement');
    output.hidden = !this.isActive;
    if (!this.isActive) return;
    const places = this.chosen.map((snap, i) => element('p', {}, `${i + 1}: ${nameOf(snap, texts)}`));
    const [from, to] = this.chosen;
    const rows: HTMLElement[] = to ? [table(from.at, to.at, texts)] : [element('p', { className: 'faint' }, from ? texts.secondPlace : texts.firstPlace)];
    if (this.next && !to) rows.push(element('p', { className: 'faint' }, nameOf(this.next, texts)));
    output.replaceChildren(...places, ...rows);
  }
}

function nameOf({ kind, line, body }: Snap, texts: Texts): string {
  const names = {
    end: texts.snapEnd,
    center: texts.snapCenter,
    corner: texts.snapCorner,
    axis: texts.snapAxis,
    path: texts.snapPath,
    surface: texts.snapSurface,
    stock: line === undefined ? texts.snapBlank : texts.snapStock,
    tip: texts.snapTip,
  };
  return names[kind].replace('{}', body ? shownName(body, texts) : String((line ?? -1) + 1));
}

/** The spoilboard, the part and the blank need no name of their own. */
const shownName = ({ name, role }: SceneBody, texts: Texts) => name || texts[`${role}Body`];

function table(from: Vector, to: Vector, texts: Texts): HTMLElement {
  const { distance, delta, angle } = measured(from, to);
  const rows: [string, string][] = [
    [texts.distance, coordinate(distance)],
    ['dX', coordinate(delta[0])],
    ['dY', coordinate(delta[1])],
    [texts.depth, coordinate(delta[2])],
    [texts.angleXY, angle === null ? '–' : `${coordinate(angle)}°`],
  ];
  return element('dl', {}, ...rows.map(([name, value]) => element('div', {}, element('dt', {}, name), element('dd', {}, value))));
}

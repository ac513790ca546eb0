/** What one chooses about the stock: its colors, a section through it, files of it. */
import type { Theme } from './colors';
import { byId, element } from './elements';
import { coordinate } from './format';
import { icon } from './icons';
import { stockModes, type StockMode } from './stock_colors';
import { stockLegend } from './stock_legend';
import type { Texts } from './texts';
import type { Toolpath } from './toolpath';
import type { ToolpathView } from './toolpath_view';

type Axis = 0 | 1 | 2;
export const axisNames = ['X', 'Y', 'Z'] as const;
const names: Record<StockMode, keyof Texts> = { tool: 'stockTool', operation: 'operation', deviation: 'deviation', depth: 'stockDepth' };
/** Of the height of a section, mm; along X and Y it goes from dexel to dexel. */
const heightStep = 0.1;

export class StockControls {
  private mode: StockMode = 'tool';
  private axis: Axis | null = null;
  private at = 0;
  private keeps: 1 | -1 = 1;
  private path: Toolpath | null = null;

  constructor(
    private readonly view: ToolpathView,
    private readonly texts: () => Texts,
    private readonly theme: () => Theme,
  ) {
    const place = byId<HTMLInputElement>('section-place');
    place.addEventListener('input', () => this.moveTo(Number(place.value)));
    byId('section-side').append(icon('otherSide'));
    byId('section-side').addEventListener('click', () => this.turn());
  }

  /** Whether there is a stock that is cut. */
  get isThere(): boolean {
    return this.view.stockModel !== null;
  }

  get hasSection(): boolean {
    return this.isThere && this.axis !== null;
  }

  private get modes(): StockMode[] {
    const { stockModel } = this.view;
    return stockModes.filter((mode) => mode !== 'deviation' || stockModel?.timeline.target);
  }

  /** The next way to color it, or the one before. */
  walkModes(direction: 1 | -1): void {
    const { modes } = this;
    this.setMode(modes[(modes.indexOf(this.mode) + direction + modes.length) % modes.length]);
  }

  /** A section upright to an axis, or none where it is this one already. */
  toggle(axis: Axis): void {
    this.cut(this.axis === axis ? null : axis);
  }

  end(): void {
    this.cut(null);
  }

  /** By so many steps. */
  move(steps: number): void {
    if (this.axis !== null) this.moveTo(this.at + steps * this.step);
  }

  /** Shows what has been cut off, and cuts off what was shown. */
  turn(): void {
    this.keeps = this.keeps === 1 ? -1 : 1;
    this.apply();
  }

  write(path: Toolpath): void {
    this.path = path;
    byId('stock').hidden = byId('save-stock').hidden = !this.isThere;
    if (!this.isThere) return;
    const { modes } = this;
    if (!modes.includes(this.mode)) this.mode = 'tool';
    this.view.colorStockBy(this.mode);
    byId('stock-modes').replaceChildren(
      ...modes.map((mode) => radio('stock-mode', mode, this.texts()[names[mode]], mode === this.mode, () => this.setMode(mode))),
    );
    const axes: (Axis | null)[] = [null, 0, 1, 2];
    byId('section-axes').replaceChildren(
      ...axes.map((axis) =>
        radio('section', axis === null ? 'none' : axisNames[axis], axis === null ? this.texts().noSection : axisNames[axis], axis === this.axis, () => this.cut(axis)),
      ),
    );
    this.writeLegend();
    this.moveTo(this.at);
  }

  writeLegend(): void {
    const { stockModel } = this.view;
    if (!stockModel || !this.path) return;
    byId('stock-legend').replaceChildren(...stockLegend(stockModel.timeline, this.path, this.mode, this.theme(), this.texts()));
  }

  private get step(): number {
    const { stockModel } = this.view;
    return this.axis === null || this.axis === 2 || !stockModel ? heightStep : stockModel.facts.spacing[this.axis];
  }

  private setMode(mode: StockMode): void {
    if (!this.isThere) return;
    this.mode = mode;
    byId<HTMLInputElement>(`stock-mode-${mode}`).checked = true;
    this.view.colorStockBy(mode);
    this.writeLegend();
  }

  /** Through the middle, so that one looks upon the face. */
  private cut(axis: Axis | null): void {
    const { stockModel } = this.view;
    if (!stockModel) return;
    const isOther = axis !== null && axis !== this.axis;
    this.axis = axis;
    byId<HTMLInputElement>(`section-${axis === null ? 'none' : axisNames[axis]}`).checked = true;
    if (isOther) {
      const [low, high] = stockModel.extent(axis);
      this.keeps = this.view.sideOf(axis) > 0 ? -1 : 1;
      this.at = (low + high) / 2;
    }
    this.moveTo(this.at);
  }

  private moveTo(at: number): void {
    const { stockModel } = this.view;
    if (this.axis !== null && stockModel) {
      const [low, high] = stockModel.extent(this.axis);
      this.at = Math.min(Math.max(at, low), high);
      const place = byId<HTMLInputElement>('section-place');
      Object.assign(place, { min: String(low), max: String(high), step: String(this.step) });
      place.value = String(this.at);
      const text = `${axisNames[this.axis]} ${coordinate(this.at)}`;
      place.setAttribute('aria-valuetext', `${text} mm`);
      byId('section-value').textContent = text;
    }
    this.apply();
  }

  private apply(): void {
    byId('section-row').hidden = this.axis === null;
    this.view.cutOff(this.axis === null ? null : { axis: this.axis, at: this.at, keeps: this.keeps });
  }
}

function radio(group: string, value: string, text: string, checked: boolean, onChange: () => void): HTMLElement {
  const input = element('input', { type: 'radio', name: group, id: `${group}-${value}`, checked });
  input.addEventListener('change', onChange);
  return element('label', {}, input, text);
}

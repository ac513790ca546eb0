/** What one chooses about a comparison of two programs: which change is shown, and how much of each path. */
import { ChangeList } from './change_list';
import { sides, type Comparison, type Row, type Side } from './comparison';
import { css, palettes, type Theme } from './colors';
import { byId } from './elements';
import { icon } from './icons';
import type { Player } from './player';
import type { Language } from './texts';
import type { Steps, Vector } from './toolpath';
import type { ToolpathView } from './toolpath_view';

const nothing: Steps = { start: -1, end: -1 };
/** Where the slider snaps: the old path alone, both, the new one alone. */
const blends = [0, 0.5, 1];

export class ComparisonControls {
  /** The lines whose turn it is have changed; -1 is none. */
  onLines: (lines: Row) => void = () => {};
  /** Somebody chose a change. */
  onChange: (change: number) => void = () => {};
  /** Who leads the tool lets go of what is selected. */
  onSeek: () => void = () => {};
  comparison: Comparison | null = null;
  private readonly list = new ChangeList();
  private change = -1;
  private lines: Row = { old: -1, new: -1 };
  /** Of the old path, in place of the step whose turn it is. */
  private selected: Steps | null = null;

  constructor(
    private readonly view: ToolpathView | null,
    private readonly player: Player,
  ) {
    const slider = byId<HTMLInputElement>('blend-part');
    slider.addEventListener('input', () => view?.blend(slider.valueAsNumber));
    this.list.onChoose = (change) => this.show(change, change === this.change);
    for (const [id, direction] of [['change-previous', -1], ['change-next', 1]] as const) {
      byId(id).append(icon(direction > 0 ? 'down' : 'up'));
      byId(id).addEventListener('click', () => this.walk(direction));
    }
  }

  take(comparison: Comparison | null): void {
    this.comparison = comparison;
    this.change = -1;
    this.selected = null;
    byId('blend').hidden = comparison === null || !this.view;
    this.view?.compare(
      comparison && { path: comparison.paths.old, markOf: comparison.stepMarks('old'), ownMarkOf: comparison.stepMarks('new') },
    );
    this.player.follow(
      comparison && {
        seconds: comparison.clock.seconds,
        timeAt: (moment) => comparison.clock.time('new', moment),
        momentAt: (time) => comparison.clock.at('new', time),
      },
    );
  }

  /** Lists have the colors of the picture. */
  setTheme(theme: Theme): void {
    for (const [mark, color] of Object.entries(palettes[theme].marks)) document.documentElement.style.setProperty(`--${mark}`, css(color));
  }

  write(language: Language): void {
    this.list.write(this.comparison, language);
  }

  /** Brings both tools to where a change is seen, and lights it up; `closely`, from near. */
  show(index: number, closely = false): void {
    const { comparison } = this;
    if (!comparison?.changes[index]) return;
    this.onSeek();
    this.player.seekMoment(comparison.momentOf(index));
    const steps = { old: comparison.stepsOf('old', index), new: comparison.stepsOf('new', index) };
    this.view?.select(steps.new ?? nothing, true);
    this.lightOld(steps.old ?? nothing, true);
    this.mark(index);
    this.onChange(index);
    const boxes = sides.flatMap((side) => {
      const box = steps[side] && comparison.paths[side].extents(() => true, steps[side]);
      return box ? [box] : [];
    });
    if (boxes.length === 0) return;
    const box = {
      min: [0, 1, 2].map((i) => Math.min(...boxes.map(({ min }) => min[i]))) as Vector,
      max: [0, 1, 2].map((i) => Math.max(...boxes.map(({ max }) => max[i]))) as Vector,
    };
    if (closely) this.view?.frame(box);
    else this.view?.reveal(box.min.map((value, i) => (value + box.max[i]) / 2) as Vector);
  }

  /** To the next change, or the one before: from the one that is shown, or from the moment. */
  walk(direction: 1 | -1): void {
    const { comparison } = this;
    if (!comparison || comparison.changes.length === 0) return;
    if (this.change >= 0) return this.show(this.change + direction);
    const moments = comparison.changes.map((_, i) => comparison.momentOf(i));
    const { moment } = this.player;
    const order = moments.map((_, i) => i).sort((one, other) => moments[one] - moments[other] || one - other);
    const next = direction > 0 ? order.find((i) => moments[i] > moment) : order.filter((i) => moments[i] < moment).at(-1);
    if (next !== undefined) this.show(next);
  }

  /** Old path, both, new path. */
  walkBlends(direction: 1 | -1): void {
    if (!this.comparison) return;
    const slider = byId<HTMLInputElement>('blend-part');
    const at = blends.findIndex((each) => each >= slider.valueAsNumber);
    slider.value = String(blends[(at + direction + blends.length) % blends.length]);
    this.view?.blend(slider.valueAsNumber);
  }

  /** Brings both tools to the end of a line of one program, and lights it up with what stands beside it. */
  choose(row: Row, side: Side): void {
    const { comparison } = this;
    if (!comparison) return;
    const chosen: Side = row[side] >= 0 ? side : side === 'old' ? 'new' : 'old';
    const { start, end } = comparison.paths[chosen].stepsOf(row[chosen]);
    this.onSeek();
    if (end > start) this.player.seekMoment(comparison.clock.at(chosen, comparison.paths[chosen].endOf(end - 1)));
    const change = comparison.changeOf(chosen, row[chosen]);
    this.mark(change);
  }

  /** To the end of the step of either program that ends next, or the one before. */
  step(direction: 1 | -1): void {
    const { comparison } = this;
    if (comparison) this.player.seekMoment(comparison.clock.neighbor(this.player.moment, direction));
  }

  /** Lets go of what is lit up. */
  release(): void {
    this.selected = null;
    this.mark(-1);
  }

  /** When the moment has changed; `settled` asks for the ends of moves alone. */
  update(settled: boolean): void {
    const { comparison } = this;
    if (!comparison) return;
    const path = comparison.paths.old;
    const time = this.oldTime;
    const place = path.at(time);
    this.view?.setOtherTime(settled && place.step >= 0 ? path.endOf(place.step) : time);
    if (!this.selected) this.lightOld(place.step < 0 ? nothing : { start: place.step, end: place.step + 1 }, false);
    const lines: Row = { old: place.step < 0 ? -1 : path.stepLine[place.step], new: this.player.step < 0 ? -1 : comparison.paths.new.stepLine[this.player.step] };
    if (lines.old === this.lines.old && lines.new === this.lines.new) return;
    this.lines = lines;
    this.onLines(lines);
  }

  /** How far the old program has run. */
  get oldTime(): number {
    return this.comparison?.clock.time('old', this.player.moment) ?? 0;
  }

  private lightOld(steps: Steps, isSelected: boolean): void {
    if (isSelected) this.selected = steps;
    this.view?.selectOther(steps, isSelected);
  }

  private mark(change: number): void {
    if (change === this.change) return;
    this.change = change;
    this.list.show(change);
  }
}

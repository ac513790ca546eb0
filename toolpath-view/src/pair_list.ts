/** Two programs beside each other, aligned by what the machine does: a row for each pair of lines, with gaps where one program has nothing. */
import { sides, signs, type Comparison, type Mark, type Row, type Side } from './comparison';
import { element } from './elements';
import { lineHeight, lineNumber } from './program_list';
import type { ProgramText } from './program_text';
import { VirtualList } from './virtual_list';

export class PairList {
  /** Somebody chose a row, in the column of one program. */
  onChoose: (row: number, side: Side) => void = () => {};
  private readonly list: VirtualList;
  private readonly digits: number;
  /** The lines whose turn it is; -1 is none. */
  private current: Row = { old: -1, new: -1 };

  constructor(
    container: HTMLElement,
    private readonly comparison: Comparison,
    private readonly programs: Record<Side, ProgramText>,
    /** What a mark is called. */
    private readonly nameOf: (mark: Mark) => string,
  ) {
    this.digits = String(Math.max(...sides.map((side) => programs[side].lineCount))).length;
    this.list = new VirtualList(container, lineHeight, (row) => this.element(row));
    container.addEventListener('click', (event) => {
      const cell = (event.target as Element).closest<HTMLElement>('.cell');
      if (cell) this.onChoose(Number(cell.parentElement?.dataset.row), cell.dataset.side as Side);
    });
    this.list.take(comparison.rowCount);
  }

  /** Marks the lines whose turn it is, and scrolls to them where they are out of sight. */
  show(lines: Row): void {
    if (lines.old === this.current.old && lines.new === this.current.new) return;
    // What has moved on is followed.
    const side: Side = lines.new !== this.current.new ? 'new' : 'old';
    this.current = lines;
    this.list.reveal(this.comparison.rowOf(side, lines[side]));
    this.list.invalidate();
  }

  /** Scrolls to a line. */
  reveal(side: Side, line: number): void {
    this.list.reveal(this.comparison.rowOf(side, line));
  }

  /** Writes it anew, as in another language. */
  write(): void {
    this.list.invalidate();
  }

  private element(index: number): HTMLElement {
    const lines = this.comparison.row(index);
    const row = element('div', { id: `row-${index + 1}`, className: 'pair' }, ...sides.map((side) => this.cell(side, lines[side])));
    row.dataset.row = String(index);
    row.setAttribute('role', 'option');
    row.setAttribute('aria-selected', String(lines.new >= 0 ? lines.new === this.current.new : lines.old === this.current.old));
    return row;
  }

  private cell(side: Side, line: number): HTMLElement {
    const cell = element('div', { className: 'cell' });
    cell.dataset.side = side;
    cell.classList.toggle('gap', line < 0);
    if (line < 0) return cell;
    const text = this.programs[side].line(line);
    const mark = this.comparison.mark(side, line);
    const sign = element('span', { className: 'sign' }, signs[mark]);
    if (mark !== 'same') {
      cell.dataset.mark = mark;
      sign.setAttribute('role', 'img');
      sign.setAttribute('aria-label', this.nameOf(mark));
      cell.title = this.nameOf(mark);
    }
    const { start, end } = this.comparison.paths[side].stepsOf(line);
    cell.classList.toggle('still', start === end && mark === 'same');
    cell.classList.toggle('current', line === this.current[side]);
    cell.append(lineNumber(line, this.digits), sign, element('span', { className: 'text', title: text }, text));
    return cell;
  }
}

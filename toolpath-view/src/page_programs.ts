/** The program beside the picture of a page: one, or two aligned. */
import { sides, type Comparison, type Mark, type Row, type Side } from './comparison';
import { byId, element } from './elements';
import { clock } from './format';
import { PairList } from './pair_list';
import type { Panel } from './panel';
import { ProgramList } from './program_list';
import type { ProgramText } from './program_text';
import { texts, type Language, type Texts } from './texts';

export interface PagePrograms {
  /** Writes what is said, in a language. */
  write(language: Language): void;
  /** To the line above or below. */
  walk(direction: 1 | -1): void;
}

export class OneProgram implements PagePrograms {
  constructor(
    private readonly panel: Panel,
    program: ProgramText,
  ) {
    const path = panel.shownPath;
    const list = new ProgramList(byId('program'), program, (line) => {
      const { start, end } = path.stepsOf(line);
      return end > start;
    });
    panel.onLine = (line) => list.show(line);
    panel.onPick = (line) => list.show(line);
    list.onChoose = (line) => panel.choose(line);
    if (path.stepCount > 0) list.show(path.stepLine[panel.player.step]);
  }

  write(): void {}

  walk(direction: 1 | -1): void {
    this.panel.walk(direction);
  }
}

const markNames: Record<Mark, keyof Texts> = { same: 'markSame', moved: 'markMoved', added: 'markAdded', removed: 'markRemoved', changed: 'markChanged' };

export class TwoPrograms implements PagePrograms {
  private readonly list: PairList;
  private readonly heads: Record<Side, HTMLElement> = { old: element('div'), new: element('div') };
  private language: Language = 'en';
  private row = -1;

  constructor(
    private readonly panel: Panel,
    private readonly comparison: Comparison,
    programs: Record<Side, ProgramText>,
  ) {
    const program = byId('program');
    const holder = element('div', { id: 'programs' });
    program.replaceWith(holder);
    holder.append(element('div', { id: 'program-heads' }, this.heads.old, this.heads.new), program);
    holder.parentElement?.classList.add('comparing');
    this.list = new PairList(program, comparison, programs, (mark) => texts[this.language][markNames[mark]]);
    const { compared } = panel;
    compared.onLines = (lines) => this.show(lines);
    compared.onChange = (change) => {
      const { old, new: now } = comparison.changes[change];
      if (now) this.list.reveal('new', now[0] - 1);
      else if (old) this.list.reveal('old', old[0] - 1);
    };
    this.list.onChoose = (index, side) => {
      compared.choose(comparison.row(index), side);
      this.row = index;
    };
    panel.compare(comparison);
  }

  write(language: Language): void {
    this.language = language;
    for (const side of sides) {
      const path = this.comparison.paths[side];
      const { name } = path.facts;
      this.heads[side].replaceChildren(
        element('span', { className: 'side' }, texts[language][side]),
        element('span', { className: 'name', title: name }, name),
        element('span', { className: 'time' }, clock(path.seconds)),
      );
    }
    this.list.write();
  }

  /** To the next row on which either program does something. */
  walk(direction: 1 | -1): void {
    const { comparison, panel } = this;
    for (let row = this.row + direction; row >= 0 && row < comparison.rowCount; row += direction) {
      const lines = comparison.row(row);
      const side = (['new', 'old'] as const).find((each) => {
        const { start, end } = comparison.paths[each].stepsOf(lines[each]);
        return lines[each] >= 0 && end > start;
      });
      if (!side) continue;
      panel.compared.choose(lines, side);
      this.row = row;
      return;
    }
  }

  private show(lines: Row): void {
    this.row = lines.new >= 0 ? this.comparison.rowOf('new', lines.new) : this.comparison.rowOf('old', lines.old);
    this.list.show(lines);
  }
}

/** The program as a list of its lines. */
import { element } from './elements';
import type { ProgramText } from './program_text';
import { VirtualList } from './virtual_list';

export const lineHeight = 20;

/** The number of a line, from 0, before its text; as wide as `digits`. */
export function lineNumber(line: number, digits: number): HTMLElement {
  const number = element('span', { className: 'number' }, String(line + 1));
  number.style.minWidth = `calc(${digits}ch + 22px)`;
  return number;
}

export class ProgramList {
  onChoose: (line: number) => void = () => {};
  private readonly list: VirtualList;
  private readonly digits: number;
  private current = -1;

  /** `moves`: whether something is done on a line. */
  constructor(
    container: HTMLElement,
    private readonly program: ProgramText,
    private readonly moves: (line: number) => boolean,
  ) {
    this.digits = String(program.lineCount).length;
    this.list = new VirtualList(container, lineHeight, (line) => this.element(line));
    container.addEventListener('click', (event) => {
      const line = (event.target as Element).closest<HTMLElement>('.line');
      if (line) this.onChoose(Number(line.dataset.line));
    });
    this.list.take(program.lineCount);
  }

  /** Marks a line, and scrolls to it where it is out of sight. */
  show(line: number): void {
    if (line === this.current) return;
    this.current = line;
    this.list.reveal(line);
    this.list.invalidate();
  }

  private element(line: number): HTMLElement {
    const row = element('div', { id: `line-${line + 1}`, className: 'line' }, lineNumber(line, this.digits), this.program.line(line));
    row.dataset.line = String(line);
    row.setAttribute('role', 'option');
    row.setAttribute('aria-selected', String(line === this.current));
    row.classList.toggle('still', !this.moves(line));
    row.classList.toggle('current', line === this.current);
    return row;
  }
}

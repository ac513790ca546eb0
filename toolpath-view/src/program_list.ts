/** The program, of which only the lines in sight are elements: a million of them scroll like ten. */
import type { ProgramText } from './program_text';

const lineHeight = 20;
/** Browsers know no taller elements; longer programs scroll in proportion. */
const tallest = 8e6;

export class ProgramList {
  onChoose: (line: number) => void = () => {};
  private readonly spacer = document.createElement('div');
  private readonly lines = document.createElement('div');
  private readonly digits: number;
  private current = -1;
  private isDue = false;

  /** `moves`: whether something is done on a line. */
  constructor(
    private readonly container: HTMLElement,
    private readonly program: ProgramText,
    private readonly moves: (line: number) => boolean,
  ) {
    this.digits = String(program.lineCount).length;
    this.lines.className = 'lines';
    this.spacer.style.height = `${this.height}px`;
    container.append(this.lines, this.spacer);
    container.addEventListener('scroll', () => this.invalidate());
    new ResizeObserver(() => this.invalidate()).observe(container);
    container.addEventListener('click', (event) => {
      const line = (event.target as Element).closest<HTMLElement>('.line');
      if (line) this.onChoose(Number(line.dataset.line));
    });
    this.draw();
  }

  /** Marks a line, and scrolls to it where it is out of sight. */
  show(line: number): void {
    if (line === this.current) return;
    this.current = line;
    const visible = this.container.clientHeight / lineHeight;
    const first = this.first;
    if (line >= 0 && (line < first + 1 || line > first + visible - 2)) this.scrollTo(line - visible / 2);
    this.invalidate();
  }

  private get height(): number {
    return Math.min(this.program.lineCount * lineHeight, tallest);
  }
  private get hidden(): number {
    return Math.max(1, this.height - this.container.clientHeight);
  }
  private get lastFirst(): number {
    return Math.max(0, this.program.lineCount - this.container.clientHeight / lineHeight);
  }
  /** The line at the upper edge, and how much of it is beyond. */
  private get first(): number {
    return (this.container.scrollTop / this.hidden) * this.lastFirst;
  }
  private scrollTo(first: number): void {
    this.container.scrollTop = (Math.min(Math.max(first, 0), this.lastFirst) / (this.lastFirst || 1)) * this.hidden;
  }

  private invalidate(): void {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => this.draw());
  }

  private draw(): void {
    this.isDue = false;
    const first = this.first;
    const start = Math.max(0, Math.floor(first) - 3);
    const end = Math.min(this.program.lineCount, Math.ceil(first + this.container.clientHeight / lineHeight) + 3);
    const elements: HTMLElement[] = [];
    for (let line = start; line < end; ++line) elements.push(this.element(line));
    this.lines.replaceChildren(...elements);
    this.lines.style.transform = `translateY(${(start - first) * lineHeight}px)`;
    const current = elements[this.current - start];
    if (current) this.container.setAttribute('aria-activedescendant', current.id);
    else this.container.removeAttribute('aria-activedescendant');
  }

  private element(line: number): HTMLElement {
    const element = document.createElement('div');
    element.id = `line-${line + 1}`;
    element.className = 'line';
    element.dataset.line = String(line);
    element.setAttribute('role', 'option');
    element.setAttribute('aria-selected', String(line === this.current));
    element.classList.toggle('still', !this.moves(line));
    element.classList.toggle('current', line === this.current);
    const number = document.createElement('span');
    number.className = 'number';
    number.style.minWidth = `calc(${this.digits}ch + 22px)`;
    number.textContent = String(line + 1);
    element.append(number, this.program.line(line));
    return element;
  }
}

/** Rows of one height, of which only those in sight are elements: a million of them scroll like ten. */

/** Browsers know no taller elements; longer lists scroll in proportion. */
const tallest = 8e6;

export class VirtualList {
  private readonly spacer = document.createElement('div');
  private readonly rows = document.createElement('div');
  private count = 0;
  private isDue = false;

  constructor(
    private readonly container: HTMLElement,
    private readonly rowHeight: number,
    private readonly make: (row: number) => HTMLElement,
  ) {
    this.rows.className = 'lines';
    container.append(this.rows, this.spacer);
    container.addEventListener('scroll', () => this.invalidate());
    new ResizeObserver(() => this.invalidate()).observe(container);
  }

  /** Shows so many rows from now on. */
  take(count: number): void {
    this.count = count;
    this.spacer.style.height = `${this.height}px`;
    this.draw();
  }

  /** Scrolls to a row where it is out of sight. */
  reveal(row: number): void {
    const visible = this.container.clientHeight / this.rowHeight;
    const { first } = this;
    if (row < 0 || (row >= first + 1 && row <= first + visible - 2)) return;
    this.container.scrollTop = (Math.min(Math.max(row - visible / 2, 0), this.lastFirst) / (this.lastFirst || 1)) * this.hidden;
  }

  /** Makes the rows in sight anew, with the next picture. */
  invalidate(): void {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => this.draw());
  }

  private get height(): number {
    return Math.min(this.count * this.rowHeight, tallest);
  }
  private get hidden(): number {
    return Math.max(1, this.height - this.container.clientHeight);
  }
  private get lastFirst(): number {
    return Math.max(0, this.count - this.container.clientHeight / this.rowHeight);
  }
  /** The row at the upper edge, and how much of it is beyond. */
  private get first(): number {
    return (this.container.scrollTop / this.hidden) * this.lastFirst;
  }

  private draw(): void {
    this.isDue = false;
    const { first } = this;
    const start = Math.max(0, Math.floor(first) - 3);
    const end = Math.min(this.count, Math.ceil(first + this.container.clientHeight / this.rowHeight) + 3);
    const elements: HTMLElement[] = [];
    for (let row = start; row < end; ++row) elements.push(this.make(row));
    this.rows.replaceChildren(...elements);
    this.rows.style.transform = `translateY(${(start - first) * this.rowHeight}px)`;
    const current = elements.find((element) => element.getAttribute('aria-selected') === 'true');
    if (current) this.container.setAttribute('aria-activedescendant', current.id);
    else this.container.removeAttribute('aria-activedescendant');
  }
}

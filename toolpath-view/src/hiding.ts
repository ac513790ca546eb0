/** The form in which one chooses what of the path is shown: tools, sections between tool changes, heights. */
import { byId, element } from './elements';
import { noFilter, sectionsOf, type Filter } from './filter';
import type { Texts } from './texts';
import type { Toolpath } from './toolpath';

export class Hiding {
  onChange: (filter: Filter) => void = () => {};
  private filter = noFilter;

  constructor() {
    byId('hiding').addEventListener('submit', (event) => event.preventDefault());
  }

  /** Whether anything is hidden. */
  get isActive(): boolean {
    const { tools, sections, lines, minZ, maxZ } = this.filter;
    return tools.size > 0 || sections.size > 0 || lines.length > 0 || minZ > -Infinity || maxZ < Infinity;
  }

  /** Hides nothing that is chosen by its place in the program, which may be another one now. */
  forgetPlaces(): void {
    this.filter = { ...this.filter, sections: new Set(), lines: [] };
  }

  /** Hides what is done on these lines, and no other lines. */
  hideLines(lines: Filter['lines']): void {
    this.set({ lines });
  }

  get chosen(): Filter {
    return this.filter;
  }

  write(path: Toolpath, texts: Texts): void {
    const used = [...new Set(path.stepTool)].map((tool) => path.facts.tools[tool].name);
    const sections = sectionsOf(path);
    const content: HTMLElement[] = [element('h3', {}, texts.hidingTools)];
    for (const name of new Set(used))
      content.push(this.box(name ?? texts.noTool, !this.filter.tools.has(name), (is) => this.set({ tools: toggled(this.filter.tools, name, is) })));
    // With one section for each tool, the list above says the same.
    if (sections.length > new Set(used).size) {
      content.push(element('h3', {}, texts.hidingSections));
      sections.forEach(({ start, end, tool }, i) => {
        const lines = `${path.stepLine[start] + 1}–${path.stepLine[end - 1] + 1}`;
        const text = `${texts.lines} ${lines}: ${path.facts.tools[tool].name ?? texts.noTool}`;
        content.push(this.box(text, !this.filter.sections.has(i), (is) => this.set({ sections: toggled(this.filter.sections, i, is) })));
      });
    }
    const { min, max } = path;
    const heights = element(
      'div',
      { className: 'heights' },
      this.height('minZ', texts.fromZ, min[2], -Infinity),
      this.height('maxZ', texts.toZ, max[2], Infinity),
    );
    const all = element('button', { type: 'button' }, texts.showAll);
    all.addEventListener('click', () => {
      this.set(noFilter);
      this.write(path, texts);
      byId('hiding').querySelector('button')?.focus();
    });
    byId('hiding').replaceChildren(...content, element('h3', {}, texts.hidingHeights), heights, all);
  }

  private set(change: Partial<Filter>): void {
    this.filter = { ...this.filter, ...change };
    this.onChange(this.filter);
  }

  private box(text: string, checked: boolean, onChange: (is: boolean) => void): HTMLElement {
    const input = element('input', { type: 'checkbox', checked });
    input.addEventListener('change', () => onChange(input.checked));
    return element('label', {}, input, element('span', {}, text));
  }

  /** A field that is empty where there is no limit; it names the end of the path then. */
  private height(key: 'minZ' | 'maxZ', text: string, end: number, none: number): HTMLElement {
    const value = this.filter[key];
    const input = element('input', { type: 'number', step: 'any', id: `hiding-${key}`, placeholder: end.toFixed(1), value: Number.isFinite(value) ? String(value) : '' });
    input.addEventListener('input', () => this.set({ [key]: input.value === '' || !Number.isFinite(input.valueAsNumber) ? none : input.valueAsNumber }));
    return element('label', {}, text, input);
  }
}

/** A set with or, where it is shown, without a value. */
function toggled<Value>(hidden: ReadonlySet<Value>, value: Value, isShown: boolean): Set<Value> {
  const next = new Set(hidden);
  if (isShown) next.delete(value);
  else next.add(value);
  return next;
}

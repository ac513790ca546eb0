/** The parts of the page: side by side where there is room, else one at a time behind tabs. */
import { byId } from '../../../toolpath-view/src/elements';

export const parts = ['source', 'findings', 'toolpath'] as const;
export type Part = (typeof parts)[number];

const isNarrow = matchMedia('(max-width: 880px), (max-height: 480px)');

export class Tabs {
  private shown: Part = 'source';

  constructor() {
    for (const part of parts) {
      byId(`tab-${part}`).addEventListener('click', () => this.show(part));
      byId(`tab-${part}`).addEventListener('keydown', (event) => this.onKey(event));
    }
    isNarrow.addEventListener('change', () => this.write());
    this.write();
  }

  show(part: Part): void {
    this.shown = part;
    this.write();
  }

  private onKey({ key }: KeyboardEvent): void {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[key];
    if (!step) return;
    this.show(parts[(parts.indexOf(this.shown) + step + parts.length) % parts.length]);
    byId(`tab-${this.shown}`).focus();
  }

  private write(): void {
    for (const part of parts) {
      const isShown = part === this.shown;
      byId(part).hidden = isNarrow.matches && !isShown;
      byId(`tab-${part}`).setAttribute('aria-selected', String(isShown));
      byId(`tab-${part}`).tabIndex = isShown ? 0 : -1;
      if (isNarrow.matches) byId(part).setAttribute('role', 'tabpanel');
      else byId(part).removeAttribute('role');
    }
  }
}

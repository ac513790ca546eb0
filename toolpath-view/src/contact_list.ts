/** What the machine would hit, as a list under the picture and as ticks on the bar of the time. */
import { byId, element } from './elements';
import { clock } from './format';
import { severities, severityOf, type Contact, type Severity } from './scene';
import { texts as textsIn, type Language } from './texts';
import type { Facts } from './toolpath';

/** Entries that the list has; who fixes the first ones sees the next. */
const maxEntries = 500;
/** Ticks nearer to each other than this part of the bar become one. */
const tickPart = 1 / 400;

export class ContactList {
  /** Somebody chose a contact. */
  onChoose: (contact: number) => void = () => {};
  private contacts: Contact[] = [];
  private lit = new Set<number>();

  constructor() {
    byId('contacts').addEventListener('keydown', (event) => this.onKey(event));
  }

  /** Writes all of it; `seconds` is the length of the bar. */
  write({ contacts = [], certificate }: Pick<Facts, 'contacts' | 'certificate'>, seconds: number, language: Language): void {
    const texts = textsIn[language];
    this.contacts = contacts;
    byId('verification').hidden = contacts.length === 0 && !certificate;
    byId('contacts').hidden = contacts.length === 0;
    byId('contacts-title').textContent = texts.contacts.replace('{}', String(contacts.length));
    const entries = contacts.slice(0, maxEntries).map((contact, i) => this.entry(contact, i, language));
    const rest = contacts.length - entries.length;
    if (rest > 0) entries.push(element('li', { className: 'more' }, texts.moreContacts.replace('{}', String(rest))));
    byId('contact-list').replaceChildren(...entries);
    byId('certificate').textContent = certificate?.[language] ?? '';
    byId('certificate').hidden = !certificate;
    byId('ticks').replaceChildren(...this.ticks(seconds));
    this.light(this.lit);
  }

  /** Marks contacts as those of the line that is shown. */
  light(contacts: Set<number>): void {
    this.lit = contacts;
    let isFirst = true;
    byId('contact-list')
      .querySelectorAll('button')
      .forEach((button, i) => {
        const is = contacts.has(i);
        if (is) button.setAttribute('aria-current', 'true');
        else button.removeAttribute('aria-current');
        if (is && isFirst && document.activeElement !== button) reveal(button);
        if (is) isFirst = false;
      });
  }

  private entry(contact: Contact, i: number, language: Language): HTMLElement {
    const texts = textsIn[language];
    const severity = severityOf(contact);
    const kind = element('span', { className: `severity ${severity}` });
    kind.setAttribute('role', 'img');
    kind.setAttribute('aria-label', { error: texts.errorSeverity, warning: texts.warning, info: texts.info }[severity]);
    const button = element(
      'button',
      { type: 'button', title: texts.closer.replace('{}', clock(contact.time)) },
      kind,
      element('span', { className: 'code' }, contact.code),
      element('span', { className: 'message' }, contact.message[language]),
      element('span', { className: 'place' }, `${texts.line} ${contact.line}`),
    );
    button.addEventListener('click', () => this.onChoose(i));
    return element('li', {}, button);
  }

  private ticks(seconds: number): HTMLElement[] {
    const worst = new Map<number, Severity>();
    for (const contact of this.contacts) {
      const place = seconds > 0 ? Math.round(Math.min(Math.max(contact.time / seconds, 0), 1) / tickPart) : 0;
      const severity = severityOf(contact);
      const known = worst.get(place);
      if (!known || severities.indexOf(severity) < severities.indexOf(known)) worst.set(place, severity);
    }
    return [...worst].map(([place, severity]) => {
      const tick = element('span', { className: severity });
      tick.style.left = `${100 * place * tickPart}%`;
      return tick;
    });
  }

  /** Up and down go from entry to entry. */
  private onKey(event: KeyboardEvent): void {
    const direction = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (!direction || event.ctrlKey || event.altKey || event.metaKey) return;
    const buttons = [...byId('contact-list').querySelectorAll('button')];
    const at = buttons.indexOf(document.activeElement as HTMLButtonElement);
    const next = buttons[at + direction];
    if (!next) return;
    event.preventDefault();
    next.focus();
  }
}

/** Scrolls the list, or in a narrow window what holds it, and not the page around it. */
function reveal(button: HTMLElement): void {
  for (const id of ['contact-list', 'verification']) {
    const scroller = byId(id);
    const [inner, outer] = [button.getBoundingClientRect(), scroller.getBoundingClientRect()];
    if (inner.top < outer.top) scroller.scrollTop -= outer.top - inner.top;
    else if (inner.bottom > outer.bottom) scroller.scrollTop += inner.bottom - outer.bottom;
  }
}

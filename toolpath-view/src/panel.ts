/** A path with all that one can choose about it, and its time: what the page of isorun and the panel of an editor share. It
 * fills the elements of page.html. */
import type { Comparison } from './comparison';
import { ComparisonControls } from './comparison_controls';
import { modes, type Color, type Mode, type Theme } from './colors';
import { ContactList } from './contact_list';
import { byId, element } from './elements';
import { clock, coordinate, feed, lengthText } from './format';
import { hasTravel } from './furniture';
import type { Filter } from './filter';
import { Hiding } from './hiding';
import { icon } from './icons';
import { legend } from './legend';
import type { MachinePosition } from './machine_position';
import { MeasureTool } from './measure_tool';
import { Player, speeds } from './player';
import { download, nameBeside } from './saving';
import { removedBy } from './stock';
import { StockControls } from './stock_controls';
import { removedVolume, volumeText } from './stock_legend';
import type { Snap } from './measuring';
import { roles, severityOf, type Contact } from './scene';
import { texts, type Language, type Texts } from './texts';
import { Kind, type Facts, type Place, type Steps, type Toolpath, type Vector } from './toolpath';
import { layerOf, ToolpathView, type Hit, type Layer, type Look } from './toolpath_view';

const looks: Look[] = ['iso', 'top', 'front', 'side'];
const layers: [Layer, keyof Texts][] = [
  ['path', 'path'],
  ['rapids', 'rapids'],
  ['tool', 'toolShown'],
  ['head', 'head'],
  ['frames', 'frames'],
  ['travel', 'travel'],
  ['stock', 'stock'],
  ['grid', 'grid'],
  ['ahead', 'ahead'],
  ['fixtures', 'fixtures'],
  ['spoilboard', 'spoilboard'],
  ['target', 'target'],
  ['machine', 'machine'],
];
/** Layers that are there where the scene has such bodies. */
const bodyLayers = new Map(roles.filter((role) => role !== 'stock').map((role) => [layerOf[role], role]));

/** A contact is shown as soon as it begins, even if the step before ends in the same moment. */
const justAfter = 1e-4; // Seconds.

export class Panel {
  readonly player: Player;
  readonly view: ToolpathView | null;
  /** The line whose turn it is has changed; -1 is none. */
  onLine: (line: number) => void = () => {};
  /** Somebody clicked a move of this line. */
  onPick: (line: number) => void = () => {};

  /** Somebody saves a file; a browser downloads it. */
  onSave: (name: string, content: Blob) => void = download;

  private readonly shown: Record<Layer, boolean>;
  private readonly littleMotion = matchMedia('(prefers-reduced-motion: reduce)');
  private totals: Totals;
  /** Of the program that this one is compared with. */
  private oldTotals: Totals | null = null;
  private selected: Steps | null = null;
  private mode: Mode = 'tool';
  private line = -1;
  private readonly contacts = new ContactList();
  private readonly hiding = new Hiding();
  readonly compared: ComparisonControls;
  private readonly measuring: MeasureTool | null;
  private readonly stock: StockControls | null;
  private isStockChosen = false;
  /** The contact that was shown last, until another line is. */
  private contact = -1;

  constructor(
    private path: Toolpath,
    private language: Language,
    private theme: Theme,
    hidden: Layer[] = [],
    /** Where its keys count. */
    private readonly keys: HTMLElement | Document = document,
  ) {
    this.shown = Object.fromEntries(layers.map(([layer]) => [layer, !hidden.includes(layer)])) as Record<Layer, boolean>;
    this.totals = totalsOf(path);
    this.player = new Player(path);
    this.view = this.makeView();
    this.showStock();
    this.measuring = this.view && new MeasureTool(this.view, () => this.tipSnap());
    this.compared = new ComparisonControls(this.view, this.player);
    this.compared.setTheme(theme);
    this.stock = this.view && new StockControls(this.view, () => this.texts, () => this.theme);
    this.setUp();
    this.write();
    this.player.onChange = () => this.update();
    this.player.seek(0);
    const settings = byId('settings').offsetWidth + 20;
    this.view?.leaveFree(byId('stage').offsetWidth > 3 * settings ? settings : 0);
    this.view?.look('iso');
  }

  private get texts(): Texts {
    return texts[this.language];
  }

  /** The path that is shown. */
  get shownPath(): Toolpath {
    return this.path;
  }

  /** Shows another path, as after an edit, from where one looks and at the line that was shown. */
  take(path: Toolpath): void {
    const line = this.line;
    this.path = path;
    this.totals = totalsOf(path);
    this.selected = null;
    this.contact = -1;
    this.hiding.forgetPlaces();
    this.view?.take(path);
    this.showStock();
    this.view?.keep(this.hiding.chosen);
    this.measuring?.restart();
    this.player.take(path);
    byId<HTMLInputElement>('scrubber').max = String(this.player.seconds);
    const { start, end } = path.stepsOf(line);
    if (end > start && !this.player.isPlaying) this.player.seekStep(end - 1);
    this.write();
  }

  /** Hides what is done on these lines, from 0, until another path is shown. */
  hideLines(lines: Filter['lines']): void {
    this.hiding.hideLines(lines);
  }

  /** Shows the path of another program beside this one, which is the new one of the comparison; null ends that. */
  compare(comparison: Comparison | null): void {
    this.oldTotals = comparison && totalsOf(comparison.paths.old);
    this.compared.take(comparison);
    this.setUpMode(comparison ? 'change' : this.mode === 'change' ? 'tool' : this.mode);
    byId<HTMLInputElement>('scrubber').max = String(this.player.seconds);
    this.write();
    if (comparison) this.view?.fit();
  }

  setTheme(theme: Theme, background?: Color): void {
    this.theme = theme;
    this.view?.setTheme(theme, background);
    this.compared.setTheme(theme);
    this.writeLegend();
    this.stock?.writeLegend();
  }

  setLanguage(language: Language): void {
    this.language = language;
    this.write();
  }

  /** Lights the moves of these lines up, and brings the tool to the end of the last one. */
  choose(first: number, last = first): void {
    const [start, end] = [this.path.stepsOf(first).start, this.path.stepsOf(last).end];
    this.select(last > first && end > start ? { start, end } : null);
    if (end > start) this.player.seekStep(end - 1);
  }

  /** Brings the tool to a line above or below, the next on which something is done. */
  walk(direction: 1 | -1): void {
    const { path, player } = this;
    if (player.step < 0) return;
    const { start, end } = path.stepsOf(path.stepLine[player.step]);
    const step = direction > 0 ? end : start - 1;
    if (step >= 0 && step < path.stepCount) this.choose(path.stepLine[step]);
  }

  /** Puts the tool where a machine has it that carries out this line, whether the path leads there or not, and lights the
   * line's moves up. */
  pose({ line, tip, b, c, seconds }: MachinePosition): void {
    this.player.isPlaying = false;
    this.select(null);
    this.player.seek(this.path.timeNear(line, tip, seconds));
    const steps = this.path.stepsOf(line);
    if (steps.end > steps.start) this.view?.select(steps);
    this.view?.pose(tip, b, c);
  }

  private makeView(): ToolpathView | null {
    try {
      const view = new ToolpathView(byId('stage'), this.path, this.theme, this.shown);
      view.onPick = (hit) => {
        if (!hit) return;
        this.player.isPlaying = false;
        this.select(null);
        this.player.seek(this.path.timeOn(hit.point, hit.part));
        this.onPick(this.path.stepLine[this.path.pointStep[hit.point]]);
      };
      view.onPickOther = (hit) => this.pickOther(hit);
      view.onContact = (contact) => this.showContact(contact);
      view.onCut = (line) => {
        this.choose(line);
        this.view?.select(this.path.stepsOf(line));
        this.onPick(line);
      };
      return view;
    } catch {
      return null;
    }
  }

  /** Somebody clicked the old path of a comparison. */
  private pickOther({ point, part }: Hit): void {
    const { comparison } = this.compared;
    if (!comparison) return;
    this.player.isPlaying = false;
    this.select(null);
    this.player.seekMoment(comparison.clock.at('old', comparison.paths.old.timeOn(point, part)));
  }

  /** A blank that the setup describes is shown unless somebody hides it; a box around what is cut only if somebody asks. */
  private showStock(): void {
    if (this.isStockChosen || !this.view?.hasStock) return;
    this.shown.stock = true;
    this.view.show('stock', true);
  }

  private setUp(): void {
    const { player } = this;
    byId('help').addEventListener('click', () => byId<HTMLDialogElement>('keys').showModal());
    byId('play').addEventListener('click', () => this.play());
    byId('previous').addEventListener('click', () => this.step(-1));
    byId('next').addEventListener('click', () => this.step(1));
    const speed = byId<HTMLSelectElement>('speed');
    for (const each of speeds) speed.append(element('option', { value: String(each) }, `${each}×`));
    speed.addEventListener('change', () => (player.speed = Number(speed.value)));
    speed.value = '1';
    const scrubber = byId<HTMLInputElement>('scrubber');
    scrubber.max = String(this.player.seconds);
    scrubber.addEventListener('input', () => {
      player.isPlaying = false;
      this.select(null);
      player.seekMoment(Number(scrubber.value));
    });
    this.compared.onSeek = () => {
      player.isPlaying = false;
      this.select(null);
    };
    this.contacts.onChoose = (contact) => this.showContact(contact, contact === this.contact);
    this.hiding.onChange = (filter) => {
      this.view?.keep(filter);
      this.markLooks();
    };
    if (this.measuring)
      this.measuring.onChange = () => {
        this.measuring?.write(this.texts);
        this.markLooks();
      };
    byId('save-picture').addEventListener('click', () => void this.savePicture());
    byId('save-stock').addEventListener('click', () => this.saveStock());
    byId('settings').addEventListener('submit', (event) => event.preventDefault());
    this.keys.addEventListener('keydown', (event) => this.onKey(event as KeyboardEvent));
    for (const name of ['previous', 'next'] as const) byId(name).append(icon(name));
  }

  /** Brings the tool to where a contact begins, and shows its line and its place; `closely`, from near. */
  showContact(index: number, closely = false): void {
    const contact = this.path.facts.contacts?.[index];
    if (!contact) return;
    this.player.isPlaying = false;
    this.select(null);
    this.player.seek(this.startOf(contact));
    this.onPick(contact.line - 1);
    this.lightContacts([index]);
    this.contact = index;
    const place = this.view?.sceneModel?.markAt(index) ?? contact.point;
    if (closely) this.view?.approach(place);
    else this.view?.reveal(place);
  }

  /** When the tool is on the line of a contact's first touch. */
  private startOf({ line, time }: Contact): number {
    const { path } = this;
    const { start, end } = path.stepsOf(line - 1);
    if (end <= start) return time;
    const [first, last] = [path.times[path.stepStart[start]], path.endOf(end - 1)];
    return Math.min(Math.max(time, first + Math.min(justAfter, (last - first) / 2)), last);
  }

  /** To the next contact of the run, or the one before. */
  private walkContacts(direction: 1 | -1): void {
    const contacts = this.path.facts.contacts ?? [];
    const starts = contacts.map((contact) => this.startOf(contact));
    // Contacts of one moment follow each other as listed.
    const order = contacts.map((_, i) => i).sort((one, other) => starts[one] - starts[other] || one - other);
    const at = order.indexOf(this.contact);
    const { time } = this.player;
    const next = at >= 0 ? order[at + direction] : direction > 0 ? order.find((i) => starts[i] > time) : order.filter((i) => starts[i] < time).at(-1);
    if (next !== undefined) this.showContact(next);
  }

  /** Lights up contacts of the line that is shown, or some of its own. */
  private lightContacts(more: number[] = []): void {
    const lit = new Set(more);
    const line = this.line + 1;
    (this.path.facts.contacts ?? []).forEach((contact, i) => {
      if (line >= contact.line && line <= Math.max(contact.line, contact.endLine)) lit.add(i);
    });
    this.contacts.light(lit);
    this.view?.lightContacts(lit);
  }

  private tipSnap(): Snap {
    const { tip, step } = this.path.at(this.player.time);
    return { at: tip, kind: 'tip', line: step < 0 ? -1 : this.path.stepLine[step] };
  }

  private async savePicture(): Promise<void> {
    const picture = await this.view?.picture();
    if (picture) this.onSave(nameBeside(this.path.facts.name, 'png'), picture);
  }

  private saveStock(): void {
    const parts = this.view?.stl();
    if (parts) this.onSave(nameBeside(this.path.facts.name, 'stl'), new Blob(parts, { type: 'model/stl' }));
  }

  private toggleHiding(): void {
    const form = byId('hiding');
    form.hidden = !form.hidden;
    this.markLooks();
    if (form.hidden) byId('hide').focus();
    else form.querySelector('input')?.focus();
  }

  private select(steps: Steps | null): void {
    const isOther = steps !== this.selected;
    this.selected = steps;
    this.view?.select(steps);
    this.compared.release();
    if (isOther) this.writeTotals();
  }

  private play(): void {
    this.select(null);
    this.player.toggle();
  }

  private seekStep(step: number): void {
    this.select(null);
    this.player.seekStep(step);
  }

  /** Who wants little motion sees the tool at the ends of its moves alone. */
  private get shownTime(): number {
    const { player, path } = this;
    return player.isPlaying && player.step >= 0 && this.littleMotion.matches ? path.endOf(player.step) : player.time;
  }

  /** The step of which the time is another moment than that of the present one. */
  private neighbor(direction: 1 | -1): number {
    let step = this.player.step;
    const isAtEnd = step >= 0 && this.player.time >= this.path.endOf(step) - 1e-9;
    if (direction > 0 && step >= 0 && !isAtEnd) return step;
    do step += direction;
    while (step > 0 && step < this.path.stepCount - 1 && this.path.stepStart[step] === this.path.stepStart[step + 1]);
    return step;
  }

  /** To the end of the next move, or the one before. */
  private step(direction: 1 | -1): void {
    if (!this.compared.comparison) return this.seekStep(this.neighbor(direction));
    this.player.isPlaying = false;
    this.select(null);
    this.compared.step(direction);
  }

  private setUpMode(mode: Mode): void {
    this.mode = mode;
    this.view?.colorBy(mode);
  }

  private setMode(mode: Mode): void {
    this.setUpMode(mode);
    byId<HTMLInputElement>(`mode-${mode}`).checked = true;
    this.writeLegend();
  }

  /** All that is said, in the language chosen. */
  private write(): void {
    const { texts } = this;
    document.documentElement.lang = this.language;
    for (const each of document.querySelectorAll<HTMLElement>('[data-label]')) {
      const text = texts[each.dataset.label as keyof Texts];
      each.setAttribute('aria-label', text);
      if (each instanceof HTMLButtonElement) each.title = text;
    }
    for (const each of document.querySelectorAll<HTMLElement>('[data-text]'))
      each.textContent = texts[each.dataset.text as keyof Texts];
    byId('help').title = texts.help;
    byId('help').setAttribute('aria-label', texts.help);
    this.writeOutcome();
    this.writeTotals();
    this.writeLooks();
    this.writeModes();
    this.writeLayers();
    this.writeLegend();
    this.writeKeys();
    byId('saving').hidden = !this.view;
    this.stock?.write(this.path);
    this.hiding.write(this.path, texts);
    this.measuring?.write(texts);
    this.contacts.write(this.path.facts, this.path.seconds, this.language);
    this.compared.write(this.language);
    this.lightContacts();
    if (!this.view) byId('stage').replaceChildren(element('p', { className: 'problem' }, texts.noWebgl));
    this.update();
  }

  /** How the run ended, and whether the machine hits something meanwhile. */
  private writeOutcome(): void {
    const { texts } = this;
    const { contacts = [] } = this.path.facts;
    const ended = ({ ending, endLine }: Facts) => texts[ending].replace('{}', String(endLine + 1));
    const { comparison } = this.compared;
    const [now, old] = [ended(this.path.facts), comparison && ended(comparison.paths.old.facts)];
    const ends = old !== null && old !== now ? `${texts.old}: ${old}. ${texts.new}: ${now}` : now;
    const count = contacts.length;
    const counted = count === 0 ? '' : `, ${(count === 1 ? texts.oneContact : texts.countedContacts).replace('{}', String(count))}`;
    const outcome = byId('outcome');
    outcome.textContent = ends + counted;
    outcome.className = contacts.some((contact) => severityOf(contact) === 'error') ? 'error' : this.path.facts.ending;
  }

  private writeTotals(): void {
    const { texts, path } = this;
    const totals = this.selected ? totalsOf(path, this.selected) : this.totals;
    const old = this.selected ? null : this.oldTotals;
    const extentOf = ({ extents }: Totals, axis: number) => {
      const { min, max } = extents ?? path;
      return `${coordinate(min[axis])}…${coordinate(max[axis])}`;
    };
    const shown = (text: (totals: Totals) => string) => {
      const [now, before] = [text(totals), old && text(old)];
      return before === null || before === now ? now : texts.was.replace('{}', () => now).replace('{}', () => before);
    };
    const rows: [string, string][] = [
      [this.selected ? texts.selection : texts.cycleTime, shown(({ seconds }) => clock(seconds))],
      [texts.moves, shown(({ moves }) => String(moves))],
      [texts.cut, shown(({ cut }) => lengthText(cut))],
      [texts.rapidPath, shown(({ rapid }) => lengthText(rapid))],
    ];
    const { stock } = path.facts;
    if (stock) {
      const lines = this.selected && { first: path.stepLine[this.selected.start], last: path.stepLine[this.selected.end - 1] };
      rows.push([texts.removed, volumeText(removedVolume(stock, lines))]);
      if (!lines) rows.push([texts.remaining, volumeText(stock.volume)]);
    }
    if (totals.moves > 0) rows.push([texts.extents, ['X', 'Y', 'Z'].map((axis, i) => `${axis} ${shown((each) => extentOf(each, i))}`).join('  ')]);
    byId('totals').replaceChildren(...rows.map(([name, value]) => element('div', {}, element('dt', {}, name), element('dd', {}, value))));
  }

  private writeLooks(): void {
    const buttons = looks.map((look) => {
      const button = element('button', { type: 'button' }, this.texts[look]);
      button.addEventListener('click', () => this.view?.look(look));
      return button;
    });
    const fit = element('button', { type: 'button', title: this.texts.fitTitle }, this.texts.fit);
    fit.addEventListener('click', (event) => this.view?.fit(event.shiftKey));
    const measure = element('button', { type: 'button', id: 'measure', title: this.texts.measure }, icon('measure'));
    measure.addEventListener('click', () => this.measuring?.toggle());
    const hide = element('button', { type: 'button', id: 'hide', title: this.texts.hide }, icon('hide'));
    hide.addEventListener('click', () => this.toggleHiding());
    hide.setAttribute('aria-controls', 'hiding');
    // Only where the settings would cover the picture.
    const display = element('button', { type: 'button', id: 'display', title: this.texts.settings }, icon('display'));
    display.addEventListener('click', () => {
      byId('settings').classList.toggle('open');
      this.markLooks();
    });
    display.setAttribute('aria-controls', 'settings');
    for (const each of [measure, hide, display]) each.setAttribute('aria-label', each.title);
    byId('looks').replaceChildren(...buttons, fit, measure, hide, display);
    this.markLooks();
  }

  /** Shows which buttons are in force. */
  private markLooks(): void {
    byId('measure').setAttribute('aria-pressed', String(this.measuring?.isActive ?? false));
    byId('hide').setAttribute('aria-expanded', String(!byId('hiding').hidden));
    byId('display').setAttribute('aria-expanded', String(byId('settings').classList.contains('open')));
    byId('hide').classList.toggle('active', this.hiding.isActive);
  }

  private writeModes(): void {
    const offered: Mode[] = this.compared.comparison ? ['change', ...modes] : modes;
    const radios = offered.map((mode) => {
      const input = element('input', { type: 'radio', name: 'mode', id: `mode-${mode}`, checked: mode === this.mode });
      input.addEventListener('change', () => this.setMode(mode));
      return element('label', {}, input, this.texts[mode]);
    });
    byId('modes').replaceChildren(...radios);
  }

  private writeLayers(): void {
    const boxes = layers
      .filter(([layer]) => (layer !== 'travel' || hasTravel(this.path)) && (layer !== 'head' || (this.path.turned.length > 0 && !this.view?.hasSpindle)))
      .filter(([layer]) => !bodyLayers.has(layer) || this.view?.hasBodies(bodyLayers.get(layer)!))
      .map(([layer, text]) => {
        const input = element('input', { type: 'checkbox', id: `layer-${layer}`, checked: this.shown[layer] });
        input.addEventListener('change', () => this.showLayer(layer, input.checked));
        return element('label', {}, input, this.texts[text]);
      });
    byId('layers').replaceChildren(...boxes);
  }

  private showLayer(layer: Layer, is: boolean): void {
    this.shown[layer] = is;
    if (layer === 'stock') this.isStockChosen = true;
    this.view?.show(layer, is);
    byId<HTMLInputElement>(`layer-${layer}`).checked = is;
  }

  private writeLegend(): void {
    const squares = this.view ? [element('div', { className: 'ends' }, this.texts.squares.replace('{}', lengthText(this.view.cell)))] : [];
    byId('legend').replaceChildren(...legend(this.path, this.mode, this.theme, this.texts, this.compared.comparison), ...squares);
  }

  private writeKeys(): void {
    const { texts } = this;
    const rows: [string[], string][] = [
      [[texts.space], texts.keyPlay],
      [['←', '→'], texts.keyStep],
      [['Home', texts.endKey], texts.keyEnds],
      [[',', '.'], texts.keySpeed],
      [['1', '2', '3', '4'], texts.keyLooks],
      [['F'], texts.keyFit],
      [['T', 'V', 'K', 'C'], texts.keyColors],
      [['M'], texts.keyMeasure],
      [['N', texts.enter], texts.keyMeasurePlaces],
      [['H'], texts.keyHide],
      [['L'], texts.keyPath],
      ...(this.compared.comparison
        ? ([
            [['D'], texts.keyChanges],
            [['W'], texts.keyBlend],
          ] as [string[], string][])
        : []),
      ...(this.path.facts.contacts?.length ? [[['E'], texts.keyContacts] as [string[], string]] : []),
      ...(this.stock?.isThere
        ? ([
            [['S', 'B'], texts.keyStock],
            [['X', 'Y', 'Z'], texts.keySection],
            [[texts.pageUp, texts.pageDown, 'R'], texts.keySectionMove],
          ] as [string[], string][])
        : []),
      [this.stock?.isThere ? ['P', 'O'] : ['P'], this.stock?.isThere ? texts.keySave : texts.keySavePicture],
      [['←', '→', '↑', '↓', '+', '-'], texts.keyStage],
      [['↑', '↓'], texts.keyProgram],
    ];
    const table = element(
      'table',
      {},
      ...rows.map(([keys, text]) =>
        element('tr', {}, element('td', {}, ...keys.flatMap((key) => [element('kbd', {}, key), ' '])), element('td', {}, text)),
      ),
    );
    const close = element('button', { type: 'button', autofocus: true }, texts.close);
    close.addEventListener('click', () => byId<HTMLDialogElement>('keys').close());
    byId('keys').setAttribute('aria-label', texts.help);
    byId('keys').replaceChildren(table, element('p', {}, texts.mouse), element('p', {}, texts.touch), close);
  }

  /** What changes with the time. */
  private update(): void {
    const { player, path, texts } = this;
    const place = path.at(this.shownTime);
    this.view?.setTime(this.shownTime);
    const line = place.step < 0 ? -1 : path.stepLine[place.step];
    if (this.contact >= 0 && player.time !== this.startOf(path.facts.contacts![this.contact])) this.contact = -1;
    this.compared.update(player.isPlaying && this.littleMotion.matches);
    if (line !== this.line) {
      this.line = line;
      this.lightContacts();
      this.onLine(line);
    }
    const play = byId('play');
    if (play.dataset.icon !== String(player.isPlaying)) play.replaceChildren(icon(player.isPlaying ? 'pause' : 'play'));
    play.dataset.icon = String(player.isPlaying);
    play.title = player.isPlaying ? texts.pause : texts.play;
    play.setAttribute('aria-label', play.title);
    const scrubber = byId<HTMLInputElement>('scrubber');
    scrubber.value = String(player.moment);
    scrubber.setAttribute('aria-valuetext', clock(player.moment));
    const times = `${clock(player.time)} / ${clock(path.seconds)}`;
    const { comparison, oldTime } = this.compared;
    byId('clock').textContent = comparison ? `${texts.old} ${clock(oldTime)} / ${clock(comparison.paths.old.seconds)} · ${texts.new} ${times}` : times;
    this.writeReadout();
  }

  private writeReadout(): void {
    const { path, texts } = this;
    const place = path.at(this.shownTime);
    const { comparison, oldTime } = this.compared;
    const old = comparison?.paths.old.at(oldTime);
    const faint = (text: string) => element('span', { className: 'faint' }, text);
    // A contact's message names its place in the frame in force.
    const rows: (Node | string)[] = comparison ? [] : [faint(texts.machineFrame), '\n'];
    const axes = ['X', 'Y', 'Z', ...(path.turned.length + (comparison?.paths.old.turned.length ?? 0) > 0 ? ['B', 'C'] : [])];
    const values = ({ tip, b, c }: Place) => axes.map((_, i) => coordinate([...tip, b, c][i]));
    if (comparison && old) {
      // A line for each program, so that what they share is below each other.
      const width = Math.max(texts.old.length, texts.new.length);
      for (const [name, shownPath, at] of [[texts.old, comparison.paths.old, old], [texts.new, path, place]] as const) {
        rows.push(faint(name.padEnd(width)));
        values(at).forEach((value, i) => rows.push(faint(` ${axes[i]}`), value.padStart(9)));
        rows.push(at.step >= 0 ? `  ${this.described(shownPath, at.step, false)}` : '', '\n');
      }
      rows.pop();
    } else {
      values(place).forEach((value, i) => rows.push(faint(axes[i]), ` ${value.padStart(10)}\n`));
    }
    if (place.step >= 0) {
      if (!comparison) rows.push(this.described(path, place.step));
      const tool = path.facts.tools[path.stepTool[place.step]].name ?? texts.noTool;
      const removed = path.facts.stock && removedBy(path.facts.stock, path.stepLine[place.step]);
      if (removed) {
        const figures = [volumeText(removed.volume), `${removed.depth.toFixed(2)} mm`, `${removed.width.toFixed(2)} mm`];
        rows.push('\n', element('span', { id: 'removes' }, texts.cutsHere.replaceAll('{}', () => figures.shift()!)));
      }
      rows.push('\n', faint(`${comparison ? `${texts.machineFrame}; ` : ''}${tool}, ${(place.speed * 60).toFixed(0)} ${texts.unit}`));
    }
    byId('readout').replaceChildren(...rows);
  }

  /** What a step does: `line 5: feed move, F 2000`; in short `line 5: F 2000`. */
  private described(path: Toolpath, step: number, isLong = true): string {
    const { texts } = this;
    const names = { [Kind.Rapid]: texts.rapid, [Kind.Feed]: texts.feedMove, [Kind.Arc]: texts.arc, [Kind.Wait]: texts.waits };
    const rate = path.stepFeed[step];
    const name = names[path.stepKind[step] as keyof typeof names];
    const parts = [...(isLong || !(rate > 0) ? [name] : []), ...(rate > 0 ? [`F ${feed(rate)}`] : [])];
    return `${texts.line} ${path.stepLine[step] + 1}: ${parts.join(', ')}`;
  }

  private onKey(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.defaultPrevented || event.ctrlKey || event.altKey || event.metaKey || byId<HTMLDialogElement>('keys').open) return;
    const handler = this.keyOn(target, event);
    if (!handler) return;
    event.preventDefault();
    handler();
  }

  private keyOn(target: HTMLElement, { key, shiftKey }: KeyboardEvent): (() => void) | undefined {
    const { view, path } = this;
    if (target.id === 'stage') {
      const turns: Record<string, () => void> = {
        ArrowLeft: () => view?.orbit(-5, 0),
        ArrowRight: () => view?.orbit(5, 0),
        ArrowUp: () => view?.orbit(0, 5),
        ArrowDown: () => view?.orbit(0, -5),
        '+': () => view?.zoom(1.2),
        '-': () => view?.zoom(1 / 1.2),
      };
      if (turns[key]) return turns[key];
    }
    if (key === 'Escape') return this.escape();
    if (['program', 'change-list'].includes(target.id) && key.startsWith('Page')) return undefined;
    if (['section-place', 'blend-part'].includes(target.id) && /^(Arrow|Home|End|Page)/.test(key)) return undefined;
    const isControl = target.matches('button, select, summary, input[type=radio], input[type=checkbox]');
    if (isControl && (key === ' ' || key === 'Enter' || key.startsWith('Arrow') || key === 'Home' || key === 'End')) return undefined;
    if (target.matches('select, input[type=number]')) return undefined;
    if (this.measuring?.isActive) {
      const { measuring } = this;
      if (key === 'Enter') return () => measuring.accept();
      if (key.toLowerCase() === 'n') return () => measuring.offer(shiftKey ? -1 : 1);
    }
    const many = (step: number, sign: number) => Math.min(Math.max(step + sign * 9, -1), path.stepCount - 1);
    const keys: Record<string, () => void> = {
      ' ': () => this.play(),
      ArrowLeft: () => (shiftKey ? this.seekStep(many(this.neighbor(-1), -1)) : this.step(-1)),
      ArrowRight: () => (shiftKey ? this.seekStep(many(this.neighbor(1), 1)) : this.step(1)),
      Home: () => this.seekStep(-1),
      End: () => (this.compared.comparison ? this.toEnd() : this.seekStep(path.stepCount - 1)),
      ',': () => this.setSpeed(-1),
      '.': () => this.setSpeed(1),
      '1': () => view?.look('iso'),
      '2': () => view?.look('top'),
      '3': () => view?.look('front'),
      '4': () => view?.look('side'),
      f: () => view?.fit(shiftKey),
      t: () => this.setMode('tool'),
      v: () => this.setMode('feed'),
      k: () => this.setMode('kind'),
      c: () => this.setMode('time'),
      m: () => this.measuring?.toggle(),
      h: () => this.toggleHiding(),
      e: () => this.walkContacts(shiftKey ? -1 : 1),
      l: () => this.showLayer('path', !this.shown.path),
      p: () => void this.savePicture(),
      '?': () => byId<HTMLDialogElement>('keys').showModal(),
      ...(this.compared.comparison && { d: () => this.compared.walk(shiftKey ? -1 : 1), w: () => this.compared.walkBlends(shiftKey ? -1 : 1) }),
      ...this.stockKeys(shiftKey),
    };
    return keys[key.length === 1 ? key.toLowerCase() : key];
  }

  private toEnd(): void {
    this.select(null);
    this.player.isPlaying = false;
    this.player.seekMoment(this.player.seconds);
  }

  private stockKeys(shiftKey: boolean): Record<string, () => void> {
    const { stock } = this;
    if (!stock?.isThere) return {};
    const far = shiftKey ? 10 : 1;
    return {
      s: () => this.showLayer('stock', !this.shown.stock),
      b: () => stock.walkModes(shiftKey ? -1 : 1),
      x: () => stock.toggle(0),
      y: () => stock.toggle(1),
      z: () => stock.toggle(2),
      o: () => this.saveStock(),
      ...(stock.hasSection && { r: () => stock.turn(), PageUp: () => stock.move(far), PageDown: () => stock.move(-far) }),
    };
  }

  /** Ends what was opened last. */
  private escape(): (() => void) | undefined {
    if (!byId('hiding').hidden) return () => this.toggleHiding();
    const { measuring } = this;
    if (measuring?.isActive) return () => measuring.end();
    const { stock } = this;
    return stock?.hasSection ? () => stock.end() : undefined;
  }

  private setSpeed(direction: 1 | -1): void {
    const at = speeds.indexOf(this.player.speed) + direction;
    this.player.speed = speeds[Math.min(Math.max(at, 0), speeds.length - 1)];
    byId<HTMLSelectElement>('speed').value = String(this.player.speed);
  }
}


interface Totals {
  moves: number;
  seconds: number;
  cut: number;
  rapid: number;
  extents: { min: Vector; max: Vector } | null;
}

function totalsOf(path: Toolpath, steps: Steps = { start: 0, end: path.stepCount }): Totals {
  const totals = { moves: 0, seconds: 0, cut: 0, rapid: 0, extents: path.extents((kind) => kind !== Kind.Wait, steps) };
  for (let step = steps.start; step < steps.end; ++step) if (path.stepKind[step] !== Kind.Wait) ++totals.moves;
  const [first, last] = [path.stepStart[steps.start], path.stepStart[steps.end]];
  for (let point = first + 1; point <= last; ++point) {
    const kind = path.stepKind[path.pointStep[point]];
    if (kind === Kind.Rapid) totals.rapid += path.lengthTo(point);
    else if (kind !== Kind.Wait) totals.cut += path.lengthTo(point);
  }
  totals.seconds = path.times[last] - path.times[first];
  return totals;
}

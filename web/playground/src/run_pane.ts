/** The buttons that step through the program, and the values of the machine where it stands. */
import { byId, element } from '../../../toolpath-view/src/elements';
import { clock, coordinate } from '../../../toolpath-view/src/format';
import { Debugger, type Standing, type Step, type Stop } from './debugger';
import { filled, texts, type Language, type Texts } from './texts';

const buttons = ['start', 'back', 'step', 'continue', 'stop'] as const;

type State =
  | { name: 'notRun' | 'edited' }
  | { name: 'busy' | 'stopped' | 'ended'; standing: Standing | null; error: string | null }
  | { name: 'notStarted'; complaint: string };

export class RunPane {
  /** The machine stands there; null where no program runs. */
  onStand: (standing: Standing | null) => void = () => undefined;

  private debugger: Debugger | null = null;
  private state: State = { name: 'notRun' };

  constructor(
    private language: Language,
    /** What is to run, as it is now. */
    private readonly program: { readonly text: string; readonly breakpointLines: readonly number[] },
  ) {
    byId('start').addEventListener('click', () => void this.start());
    byId('step').addEventListener('click', () => this.go('next'));
    byId('back').addEventListener('click', () => this.go('stepBack'));
    byId('continue').addEventListener('click', () => this.go('continue'));
    byId('stop').addEventListener('click', () => this.end());
    document.addEventListener('keydown', (event) => this.onKey(event), { capture: true });
    this.write();
  }

  get isRunning(): boolean {
    return this.debugger !== null;
  }

  setLanguage(language: Language): void {
    this.language = language;
    this.write();
  }

  /** The program has other breakpoints. */
  updateBreakpoints(): void {
    void this.debugger?.setBreakpoints(this.program.breakpointLines);
  }

  /** Another program, or an edited one: a run belongs to the program that it has begun with. */
  leave(isOther: boolean): void {
    if (!this.debugger && !isOther) {
      if (this.state.name === 'ended' || this.state.name === 'notStarted') this.show({ name: 'notRun' });
      return;
    }
    const wasRunning = this.isRunning && !isOther;
    this.debugger?.stop();
    this.debugger = null;
    this.show({ name: wasRunning ? 'edited' : 'notRun' });
    this.onStand(null);
  }

  private async start(): Promise<void> {
    if (this.debugger || this.state.name === 'busy') return;
    this.show({ name: 'busy', standing: null, error: null });
    try {
      await Debugger.start(this.program.text, this.language, this.program.breakpointLines, (made) => {
        this.debugger = made;
        made.onStop = (stop) => this.stand(stop);
        made.onEnd = (last) => this.finish(last);
      });
    } catch (failure) {
      this.debugger = null;
      this.show({ name: 'notStarted', complaint: (failure as Error).message });
    }
  }

  private go(step: Step): void {
    if (!this.debugger || this.state.name !== 'stopped') return;
    this.state = { ...this.state, name: 'busy' };
    byId('run').dataset.state = 'busy';
    // What cannot be done, as a step back from the start, leaves the machine where it is.
    this.debugger.go(step).catch(() => {
      if (this.state.name === 'busy') this.show({ ...this.state, name: 'stopped' });
    });
  }

  private stand({ standing, error }: Stop): void {
    this.show({ name: 'stopped', standing, error });
    this.onStand(standing);
  }

  private finish(last: Standing | null): void {
    this.debugger = null;
    this.show({ name: 'ended', standing: last, error: null });
    if (last) this.onStand(last);
    this.onStand(null);
  }

  private end(): void {
    this.debugger?.stop();
    this.debugger = null;
    this.show({ name: 'notRun' });
    this.onStand(null);
    byId('start').focus();
  }

  private onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const name = `${event.shiftKey ? 'Shift+' : ''}${event.key}`;
    const actions: Record<string, () => void> = {
      F5: () => (this.isRunning ? this.go('continue') : void this.start()),
      'Shift+F5': () => this.end(),
      F10: () => (this.isRunning ? this.go('next') : void this.start()),
      'Shift+F10': () => this.go('stepBack'),
    };
    // Without a run, F5 is the browser's.
    if (!actions[name] || (!this.isRunning && name.endsWith('F5'))) return;
    event.preventDefault();
    event.stopPropagation();
    actions[name]();
  }

  private show(state: State): void {
    this.state = state;
    this.write();
  }

  private write(): void {
    const said = texts[this.language];
    const { state } = this;
    byId('run').dataset.state = state.name;
    for (const name of buttons) {
      const button = byId<HTMLButtonElement>(name);
      const isStart = name === 'start';
      button.textContent = said[name];
      button.title = said[`${name}Title`];
      const isLive = this.debugger !== null;
      button.setAttribute('aria-disabled', String(isStart === isLive || (isStart && state.name === 'busy')));
    }
    byId('run-state').textContent = this.stateText(said);
    byId('run-state').className = state.name === 'notStarted' || ('error' in state && state.error) ? 'error' : '';
    const standing = 'standing' in state ? state.standing : null;
    byId('values').hidden = standing === null;
    if (standing) byId('values').replaceChildren(...rowsOf(standing, said));
  }

  private stateText(said: Texts): string {
    const { state } = this;
    switch (state.name) {
      case 'notRun':
      case 'edited':
        return said[state.name];
      case 'notStarted':
        return filled(said.notStarted, state.complaint);
      case 'ended':
        return said.ended;
      default: {
        if (!state.standing) return '…';
        const where = filled(state.error === null ? said.stopped : said.stoppedByError, state.standing.line + 1);
        return state.error === null ? where : `${where}: ${state.error}`;
      }
    }
  }
}

function rowsOf({ programmed, seconds, feed, spindle, tool }: Standing, said: Texts): HTMLElement[] {
  const axes = (['x', 'y', 'z', 'b', 'c'] as const).filter((axis) => 'xyz'.includes(axis) || programmed[axis] !== 0);
  const turns = spindle.function === 5 || spindle.function === 0 ? said.stands : `M${String(spindle.function).padStart(2, '0')} S${spindle.speed}`;
  const rows: [string, string][] = [
    [said.position, axes.map((axis) => `${axis.toUpperCase()} ${coordinate(programmed[axis])}`).join('  ')],
    [said.feed, feed === '' ? '–' : `F ${feed}`],
    [said.spindle, turns],
    [said.tool, tool?.name ?? said.noTool],
    [said.time, clock(seconds)],
  ];
  return rows.map(([name, value]) => element('div', {}, element('dt', {}, name), element('dd', {}, value)));
}

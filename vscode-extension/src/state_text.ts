/** The answer to isocnc/state as a text for people. */

export interface Pose {
  x: number | null;
  y: number | null;
  z: number | null;
  b: number | null;
  c: number | null;
}

export interface MachineState {
  inForce: Record<string, number | null>;
  position: Pose;
  machinePosition: Pick<Pose, 'x' | 'y' | 'z'> | null;
  workpieceOrigin: Pick<Pose, 'x' | 'y' | 'z'>;
  faceMounted: boolean;
  spindle: { function: number; speed: number };
  tool: string | null;
  feed: number | null;
}

export interface StateAnswer {
  before: MachineState | null;
  after: MachineState | null;
}

/** What stands in the first column, in the reader's language. */
export type Translate = (text: string) => string;

const groups: [key: string, name: string][] = [
  ['motion', 'motion'],
  ['plane', 'arc plane'],
  ['face', 'face frame'],
  ['distance', 'dimensions'],
  ['units', 'units'],
  ['feedMode', 'feed mode'],
  ['interpolation', 'interpolation'],
  ['cutterCompensation', 'cutter compensation'],
  ['profileReduction', 'profile reduction'],
];

const number = (value: number | null | undefined) => (value == null ? '?' : String(Number(value.toFixed(4))));
const place = (at: Partial<Pose> | null) =>
  at ? Object.entries(at).map(([axis, value]) => `${axis.toUpperCase()}${number(value)}`).join(' ') : '?';
const code = (letter: string, value: number | null | undefined) =>
  value == null ? '-' : `${letter}${String(value).padStart(2, '0')}`;

function rowsOf(state: MachineState): Record<string, string> {
  const { spindle } = state;
  return {
    position: place(state.position),
    'machine position': place(state.machinePosition),
    'workpiece zero': place(state.workpieceOrigin),
    tool: state.tool ? `T${state.tool}` : '-',
    spindle: spindle.speed ? `${code('M', spindle.function)} S${number(spindle.speed)}` : code('M', spindle.function),
    'feed rate': state.feed === null ? '-' : `F${number(state.feed)}`,
    ...Object.fromEntries(groups.map(([key, name]) => [name, code('G', state.inForce[key])])),
  };
}

/** A table: before and after the line, with a mark where it changes something. */
export function stateText({ before, after }: StateAnswer, heading: string, translate: Translate): string {
  const [from, to] = [before, after].map((state) => (state ? rowsOf(state) : null));
  if (!from && !to) return `${heading}\n\n${translate('No path leads here, or paths differ.')}\n`;
  const names = Object.keys(from ?? to!);
  const rows = names.map((name) => [translate(name), from?.[name] ?? '?', to?.[name] ?? '?']);
  const head = ['', translate('before'), translate('after')];
  const widths = [0, 1, 2].map((column) => Math.max(...[head, ...rows].map((row) => row[column].length)));
  const line = (row: string[]) => {
    const isChanged = row !== head && row[1] !== row[2];
    return `${isChanged ? '*' : ' '} ${row.map((cell, column) => cell.padEnd(widths[column])).join('  ')}`.trimEnd();
  };
  return [heading, '', ...[head, ...rows].map(line), ''].join('\n');
}

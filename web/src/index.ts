/** The checker, the formatter and the simulated machine for ISOCNC programs, on texts in memory. Works in pages and in Node.js. */
import makeModule from './glue';
import type { Files, Module, Program } from './module';
import { runOnText } from './streams';

export interface Options {
  /** The language of messages; else English. */
  language?: 'en' | 'it';
  /** What an isocnc.json beside the program says: its text, or its value. */
  configuration?: string | object;
  /** What stands beside the program, by names as the configuration has them: `part.setup.json`, STL files, stocks. */
  files?: Readonly<Record<string, string | Uint8Array>>;
  /** What the program is called in results; else program.iso. */
  filename?: string;
  /** Further options of the command, as in a shell: `['--select', 'ALL']`. */
  args?: readonly string[];
}

export interface RunOptions extends Options {
  /** Whether the result has each event of the run. */
  trace?: boolean;
}

/** A place, from 1; columns count characters, and the end is the first one after it. */
export interface Range {
  line: number;
  column: number;
  endLine: number;
  endColumn: number;
}

/** One of those that `isolint --format json` prints. */
export interface Finding extends Range {
  file: string;
  severity: 'error' | 'warning' | 'info';
  code: string;
  name: string;
  message: string;
  url: string;
  fix: { title: string; safe: boolean; edits: (Range & { text: string })[] } | null;
  /** The jumps by which the finding is reached, where it is not on all paths. */
  path: { line: number; text: string }[] | null;
  /** How many lines repeat the finding, and the last of them. */
  repeats?: number;
  lastLine?: number;
  /** With `--verify`: a run alone has shown it. */
  source?: 'run';
}

/** What `isorun --json` prints, and with `trace` the events that `isorun --trace` writes. */
export interface Run {
  [key: string]: unknown;
  trace?: Record<string, unknown>[];
}

/** What is different in what two programs do, as `isodiff --format json` prints it. */
export interface Change {
  kind: 'moved' | 'shape' | 'added' | 'removed' | 'reordered' | 'feed' | 'speed' | 'tool' | 'function' | 'frame' | 'dwell' | 'path' | 'end';
  /** The first and the last line, from 1, of each program that has a part in it. */
  old: [number, number] | null;
  new: [number, number] | null;
  tool: string | null;
  /** In mm. */
  distance: number | null;
  /** How much longer the new program takes for it. */
  seconds: number;
  text: string;
}

/** What a program does as a whole. */
export interface ComparedRun {
  /** Cycle time in seconds. */
  time: number;
  /** Length of feed moves, and of rapids, in mm. */
  feedMm: number;
  rapidMm: number;
  /** Of the tip, mm, in machine coordinates; null without a motion. */
  extents: Record<'X' | 'Y' | 'Z', [number, number]> | null;
  /** mm^3, with `--verify` and a stock. */
  removedVolume?: number;
  /** In the order of their first use; times in seconds, with their tool changes. */
  tools: { tool: string; time: number; removedVolume?: number }[];
}

/** A finding that one of the programs alone has, or that says something else in the new one. */
export interface ComparedFinding {
  kind: 'new' | 'gone' | 'changed';
  code: string;
  severity: 'error' | 'warning' | 'info';
  /** Its line in each program, from 1. */
  old: number | null;
  new: number | null;
  text: string;
  /** Of a changed one, what it said. */
  oldText?: string;
}

export interface Comparison {
  same: boolean;
  old: ComparedRun;
  new: ComparedRun;
  changes: Change[];
  findings: ComparedFinding[];
  /** Jumps, lines from 1, at which other values of VGPL or of a register lead along paths that are not compared. */
  otherPaths?: { revision: 'old' | 'new'; name: string; line: number }[];
}

/** What a command says instead of a result: a mistake in the options or the configuration, or a text that is no program. */
export class CommandError extends Error {
  override readonly name = 'CommandError';
}

/** The content of isocnc.wasm. */
async function readWasm(): Promise<ArrayBuffer | Uint8Array> {
  const place = new URL('./isocnc.wasm', import.meta.url);
  if (place.protocol !== 'file:') {
    const response = await fetch(place);
    if (!response.ok) throw new Error(`isocnc.wasm: ${response.status} ${response.statusText}`);
    return response.arrayBuffer();
  }
  const { readFile } = await import('node:fs/promises');
  return readFile(place);
}

let loaded: Promise<Module> | undefined;

async function made(wasmBinary?: ArrayBuffer | Uint8Array): Promise<Module> {
  return makeModule({ wasmBinary: wasmBinary ?? (await readWasm()) });
}

/** Loads the module, once. The other functions do so by themselves. */
export async function load(wasmBinary?: ArrayBuffer | Uint8Array): Promise<void> {
  loaded ??= made(wasmBinary);
  await loaded;
}

const home = '/isocnc';
const trace = '/isocnc.trace';

/** Writes the files of a call into the module's memory, and returns their paths. */
function place(FS: Files, files: Options['files'] = {}): string[] {
  const isOutside = (name: string) => name.split('/').some((step) => ['', '.', '..'].includes(step));
  const outside = Object.keys(files).find(isOutside);
  if (outside !== undefined) throw new CommandError(`${outside}: not the name of a file beside the program or below`);
  return Object.entries(files).map(([name, content]) => {
    const path = `${home}/${name}`;
    FS.mkdirTree(path.slice(0, path.lastIndexOf('/')));
    FS.writeFile(path, content);
    return path;
  });
}

/** Throws where a caller without types has given what is no option. */
function checked(options: Options): void {
  const known = ['language', 'configuration', 'files', 'filename', 'args', 'trace'];
  if (typeof options !== 'object') throw new CommandError('the options are no object');
  const unknown = Object.keys(options).find((key) => !known.includes(key));
  if (unknown !== undefined) throw new CommandError(`${unknown}: no such option; there are ${known.join(', ')}`);
  const { language, filename, files } = options;
  if (language !== undefined && language !== 'en' && language !== 'it') throw new CommandError('language: en or it');
  if (filename !== undefined && (typeof filename !== 'string' || filename === '')) throw new CommandError('filename: a name');
  for (const [name, content] of Object.entries(files ?? {}))
    if (typeof content !== 'string' && !(content instanceof Uint8Array)) throw new CommandError(`${name}: neither a text nor a Uint8Array`);
}

/** What the command writes to its standard output, or to a `file`. Calls at the same time run one after another. */
async function command(program: Program, text: string, options: Options, args: readonly string[], file?: string): Promise<string[]> {
  if (typeof text !== 'string') throw new TypeError('the program is no text');
  checked(options);
  await load();
  const module = await loaded!;
  module.FS.mkdirTree(home);
  module.FS.chdir(home);
  const { configuration } = options;
  const own: string[] = ['--lang', options.language ?? 'en'];
  if (configuration === undefined) own.push('--no-config');
  else module.FS.writeFile(`${home}/isocnc.json`, typeof configuration === 'string' ? configuration : JSON.stringify(configuration));
  const placed = place(module.FS, options.files);
  const { status, output, complaints } = runOnText(module, program, [...args, ...own, ...(options.args ?? []), '-'], text);
  for (const path of placed) module.FS.unlink(path);
  if (status === 2) throw new CommandError(complaints.trim());
  return file === undefined ? [output] : [output, module.FS.readFile(file, { encoding: 'utf8' })];
}

/** Options among `args` can ask for something else than a result. */
function parsed<Result>(json: string, isResult: (value: unknown) => value is Result): Result {
  try {
    const value: unknown = JSON.parse(json);
    if (isResult(value)) return value;
  } catch {
    // It is no JSON.
  }
  throw new CommandError('the options in args ask for something else than a result');
}

/** The findings of a program, as `isolint --format json` gives them. */
export async function check(text: string, options: Options = {}): Promise<Finding[]> {
  const name = options.filename ?? 'program.iso';
  const [json] = await command('isolint', text, options, ['--format', 'json', '--stdin-filename', name]);
  return parsed(json, (value): value is Finding[] => Array.isArray(value) && value.every((each: object) => 'message' in each));
}

/** The program as `isofmt` writes it. */
export async function format(text: string, options: Options = {}): Promise<string> {
  const name = options.filename ?? 'program.iso';
  const [formatted] = await command('isofmt', text, options, ['--stdout', '--stdin-filename', name]);
  return formatted;
}

/** Runs a program on the simulated machine: the summary of `isorun --json`. A program that the control would stop has a result that says so. */
export async function run(text: string, options: RunOptions = {}): Promise<Run> {
  const args = options.trace ? ['--json', '--trace', trace] : ['--json'];
  const [json, events] = await command('isorun', text, options, args, options.trace ? trace : undefined);
  const ran = parsed(json, (value): value is Run => typeof value === 'object' && value !== null && 'result' in value);
  const summary = { ...ran, file: options.filename ?? 'program.iso' };
  if (events === undefined) return summary;
  const lines = events.split('\n').filter((line) => line !== '');
  return { ...summary, trace: lines.map((line) => JSON.parse(line) as Record<string, unknown>) };
}

/** Compares what two programs do on the simulated machine, as `isodiff --format json` tells it. */
export async function diff(oldText: string, newText: string, options: Options = {}): Promise<Comparison> {
  if (typeof oldText !== 'string') throw new TypeError('the old program is no text');
  const old = '.isocnc-old.iso'; // In the folder of the new one: both have its configuration.
  const [json] = await command('isodiff', newText, { ...options, files: { ...options.files, [old]: oldText } }, ['--format', 'json', old]);
  return parsed(json, (value): value is Comparison => typeof value === 'object' && value !== null && 'changes' in value);
}

/** Files of the workspace for the module, which sees only those in its own memory. */
import * as vscode from 'vscode';
import { nameOf, uriOf, uriOfPath } from '../files';
import { shapesIn, setupNameOf, setupEnding } from './named_files';
import { isComplete, pathOf } from './names';

/** By the paths that the module has; null where a file has been removed. */
export type Files = Record<string, Uint8Array | null>;

const configuration = 'isocnc.json';
/** What a search for programs looks at beside them. */
const searched = [configuration, '.gitignore'];
const skipped = ['.git', 'node_modules'];
/** Nothing larger is read as a shape. */
const largestShape = 512 << 20; // Bytes.

async function read(uri: vscode.Uri): Promise<Uint8Array | null> {
  try {
    return await vscode.workspace.fs.readFile(uri);
  } catch {
    return null;
  }
}

export async function fileOf(uri: vscode.Uri): Promise<Files> {
  return { [pathOf(uri)]: await read(uri) };
}

const merged = (all: Files[]): Files => Object.assign({}, ...all) as Files;
const onlyThere = (files: Files): Files => Object.fromEntries(Object.entries(files).filter(([, content]) => content));

/** A configuration, however it is called, or a setup. */
const isDescription = (name: string) => name.toLowerCase().endsWith('.json');

async function typeOf(uri: vscode.Uri): Promise<vscode.FileStat | null> {
  return Promise.resolve(vscode.workspace.fs.stat(uri)).catch(() => null);
}

/** A file with a shape in a folder or below; null for one that is not there. A link might lead to a file that is none of the folder's. */
async function shapeOf(folder: vscode.Uri, steps: readonly string[]): Promise<Files> {
  const place = (count: number) => vscode.Uri.joinPath(folder, ...steps.slice(0, count));
  const stats = await Promise.all(steps.map((_, i) => typeOf(place(i + 1))));
  const isPlain = stats.every((stat, i) => stat?.type === (i + 1 === steps.length ? vscode.FileType.File : vscode.FileType.Directory));
  const uri = place(steps.length);
  return isPlain && stats.at(-1)!.size <= largestShape ? fileOf(uri) : { [pathOf(uri)]: null };
}

/** Descriptions with the shapes that they name, which the module reads where it verifies a program. */
async function withShapes(descriptions: readonly vscode.Uri[]): Promise<Files> {
  const all = descriptions.map(async (uri) => {
    const content = await read(uri);
    const folder = vscode.Uri.joinPath(uri, '..');
    const shapes = content ? shapesIn(new TextDecoder().decode(content)).map((steps) => shapeOf(folder, steps)) : [];
    return merged([{ [pathOf(uri)]: content }, ...(await Promise.all(shapes))]);
  });
  return merged(await Promise.all(all));
}

/** What has become of a file: of one that describes what surrounds programs, with the shapes that it names. */
export async function changed(uri: vscode.Uri): Promise<Files> {
  return isDescription(nameOf(uri)) ? withShapes([uri]) : fileOf(uri);
}

/** The setup beside a program, with its shapes. */
export async function setupBeside(uri: vscode.Uri): Promise<Files> {
  return onlyThere(await withShapes([vscode.Uri.joinPath(uri, '..', setupNameOf(nameOf(uri)))]));
}

/** The configurations above a file, with their shapes: up to its workspace folder, or in files of this computer up to the root. */
export async function configurationsAbove(uri: vscode.Uri): Promise<Files> {
  const end = uri.scheme === 'file' ? '' : (vscode.workspace.getWorkspaceFolder(uri)?.uri.path.replace(/\/$/, '') ?? '');
  const places: vscode.Uri[] = [];
  for (let folder = uri.path; folder.length > end.length; ) {
    folder = folder.slice(0, folder.lastIndexOf('/'));
    places.push(uri.with({ path: `${folder}/${configuration}`, query: '', fragment: '' }));
  }
  return onlyThere(await withShapes(places));
}

/** Whether a file in a folder is a program, or what a search for programs or their verification looks at. */
const isWanted = (name: string, endings: readonly string[]) =>
  searched.includes(name) || name.endsWith(setupEnding) || endings.some((ending) => name.toLowerCase().endsWith(ending));

/** The programs in a folder, and what describes their surroundings. */
async function filesBelow(folder: vscode.Uri, endings: readonly string[]): Promise<Files> {
  const entries = await Promise.resolve(vscode.workspace.fs.readDirectory(folder)).catch(() => []);
  const found = entries.map(async ([name, type]): Promise<Files> => {
    const uri = vscode.Uri.joinPath(folder, name);
    // A link may lead around in a circle.
    if (type === vscode.FileType.Directory) return skipped.includes(name) ? {} : filesBelow(uri, endings);
    return type & vscode.FileType.File && isWanted(name, endings) ? changed(uri) : {};
  });
  return onlyThere(merged(await Promise.all(found)));
}

/** What a server or a command can see of a folder. */
export async function filesOfFolder(folder: vscode.Uri, endings: readonly string[]): Promise<Files> {
  return merged(await Promise.all([configurationsAbove(vscode.Uri.joinPath(folder, configuration)), filesBelow(folder, endings)]));
}

/** The files that a command's arguments name, and the arguments with the names that the module has: in its working directory short ones. */
export async function filesOfArguments(args: readonly string[], folder: string, endings: readonly string[]): Promise<{ files: Files; args: string[] }> {
  const all: Files[] = [];
  for (const text of args) {
    if (text === '' || text.startsWith('-')) continue;
    const uri = uriOf(text);
    const { type } = await Promise.resolve(vscode.workspace.fs.stat(uri)).catch(() => ({ type: vscode.FileType.Unknown }));
    if (type & vscode.FileType.Directory) all.push(await filesOfFolder(uri, endings));
    else if (type & vscode.FileType.File) all.push(await changed(uri), await configurationsAbove(uri), await setupBeside(uri));
  }
  const inModule = (text: string) => {
    const path = pathOf(uriOf(text));
    return path.startsWith(`${folder}/`) ? path.slice(folder.length + 1) : path;
  };
  return { files: merged(all), args: args.map((text) => (isComplete(text) ? inModule(text) : text)) };
}

/** Writes what a command has left in the module's memory. */
export async function write(files: Record<string, Uint8Array>): Promise<void> {
  for (const [path, content] of Object.entries(files)) await vscode.workspace.fs.writeFile(uriOfPath(path), content);
}

/** Reports files that the module may look at when they change; `isKnown` tells of a shape whether one of them names it. */
export function watch(endings: readonly string[], isKnown: (path: string) => boolean, onChange: (files: Files) => void): vscode.Disposable {
  const watcher = vscode.workspace.createFileSystemWatcher('**/*');
  const look = async (uri: vscode.Uri) => {
    if (isWanted(nameOf(uri), endings) || isKnown(pathOf(uri))) onChange(await changed(uri));
  };
  return vscode.Disposable.from(watcher, watcher.onDidCreate(look), watcher.onDidChange(look), watcher.onDidDelete(look));
}

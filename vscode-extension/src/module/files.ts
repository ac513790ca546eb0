/** Files of the workspace for the module, which sees only those in its own memory. */
import * as vscode from 'vscode';
import { nameOf, uriOf, uriOfPath } from '../files';
import { isComplete, pathOf } from './names';

/** By the paths that the module has; null where a file has been removed. */
export type Files = Record<string, Uint8Array | null>;

const configuration = 'isocnc.json';
/** What a search for programs looks at beside them. */
const searched = [configuration, '.gitignore'];
const skipped = ['.git', 'node_modules'];

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

/** The configurations above a file: up to its workspace folder, or in files of this computer up to the root. */
export async function configurationsAbove(uri: vscode.Uri): Promise<Files> {
  const end = uri.scheme === 'file' ? '' : (vscode.workspace.getWorkspaceFolder(uri)?.uri.path.replace(/\/$/, '') ?? '');
  const places: vscode.Uri[] = [];
  for (let folder = uri.path; folder.length > end.length; ) {
    folder = folder.slice(0, folder.lastIndexOf('/'));
    places.push(uri.with({ path: `${folder}/${configuration}`, query: '', fragment: '' }));
  }
  return onlyThere(merged(await Promise.all(places.map(fileOf))));
}

/** The programs in a folder, and what a search for them looks at. */
async function filesBelow(folder: vscode.Uri, endings: readonly string[]): Promise<Files> {
  const isWanted = (name: string) => searched.includes(name) || endings.some((ending) => name.toLowerCase().endsWith(ending));
  const entries = await Promise.resolve(vscode.workspace.fs.readDirectory(folder)).catch(() => []);
  const found = entries.map(async ([name, type]): Promise<Files> => {
    const uri = vscode.Uri.joinPath(folder, name);
    // A link may lead around in a circle.
    if (type === vscode.FileType.Directory) return skipped.includes(name) ? {} : filesBelow(uri, endings);
    return type & vscode.FileType.File && isWanted(name) ? fileOf(uri) : {};
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
    else if (type & vscode.FileType.File) all.push(await fileOf(uri), await configurationsAbove(uri));
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

/** Reports files that the module may look at when they change. */
export function watch(endings: readonly string[], onChange: (files: Files) => void): vscode.Disposable {
  const watcher = vscode.workspace.createFileSystemWatcher('**/*');
  const look = async (uri: vscode.Uri) => {
    const name = nameOf(uri);
    if (searched.includes(name) || endings.some((ending) => name.toLowerCase().endsWith(ending))) onChange(await fileOf(uri));
  };
  return vscode.Disposable.from(watcher, watcher.onDidCreate(look), watcher.onDidChange(look), watcher.onDidDelete(look));
}

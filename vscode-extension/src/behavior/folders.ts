/** Two folders, such as what a CAM system has posted today and last week: which programs differ, and in what they do. */
import * as vscode from 'vscode';
import { nameOf } from '../files';
import { differingPairs, type Pair } from './folder_pairs';

/** How many programs of a folder are compared. */
const most = 2000;

type ShowDiff = (old: vscode.Uri, now: vscode.Uri, title: string) => Promise<void>;

/** Two that are selected in the Explorer; or a folder and one that is chosen, which is the old one. */
export async function compareFolders(endings: readonly string[], show: ShowDiff, folder?: vscode.Uri, chosen?: vscode.Uri[]): Promise<void> {
  if (!folder) return;
  const other = chosen?.length === 2 ? chosen.find((each) => each.toString() !== folder.toString()) : await chooseFolder(folder);
  if (!other) return;
  const pairs = await vscode.window.withProgress(
    { location: vscode.ProgressLocation.Notification, title: vscode.l10n.t('Comparing {0} with {1}...', nameOf(folder), nameOf(other)) },
    async () => differingPairs(await contents(other, endings), await contents(folder, endings)),
  );
  if (!pairs.length) {
    await vscode.window.showInformationMessage(vscode.l10n.t('{0} and {1} have the same programs.', nameOf(other), nameOf(folder)));
    return;
  }
  const placeHolder = vscode.l10n.t('{0} programs differ between {1} and {2}', pairs.length, nameOf(other), nameOf(folder));
  const picked = await vscode.window.showQuickPick(pairs.map((pair) => item(pair, nameOf(other), nameOf(folder))), { placeHolder });
  if (!picked) return;
  const [old, now] = [other, folder].map((each) => vscode.Uri.joinPath(each, picked.label));
  if (picked.pairing === 'changed') await show(old, now, `${picked.label} (${nameOf(other)} ↔ ${nameOf(folder)})`);
  else await vscode.window.showTextDocument(picked.pairing === 'onlyOld' ? old : now);
}

function item({ path, pairing }: Pair, old: string, now: string) {
  const descriptions = { changed: '', onlyOld: vscode.l10n.t('only in {0}', old), onlyNew: vscode.l10n.t('only in {0}', now) };
  return { label: path, description: descriptions[pairing], pairing };
}

async function chooseFolder(beside: vscode.Uri): Promise<vscode.Uri | undefined> {
  const chosen = await vscode.window.showOpenDialog({
    defaultUri: vscode.Uri.joinPath(beside, '..'),
    canSelectFiles: false,
    canSelectFolders: true,
    title: vscode.l10n.t('Compare Behavior with Folder'),
  });
  return chosen?.[0];
}

/** The bytes of the programs in a folder and below it, by their paths in it. */
async function contents(folder: vscode.Uri, endings: readonly string[]): Promise<Map<string, string>> {
  const files = new Map<string, string>();
  for await (const [path, uri] of programsIn(folder, '', endings)) {
    if (files.size === most) throw new Error(vscode.l10n.t('{0} has more than {1} programs.', nameOf(folder), most));
    files.set(path, new TextDecoder('latin1').decode(await vscode.workspace.fs.readFile(uri)));
  }
  return files;
}

async function* programsIn(folder: vscode.Uri, path: string, endings: readonly string[]): AsyncGenerator<[path: string, uri: vscode.Uri]> {
  for (const [name, type] of await vscode.workspace.fs.readDirectory(folder)) {
    const uri = vscode.Uri.joinPath(folder, name);
    // A link to a folder may lead back above it.
    if (type === vscode.FileType.Directory) yield* programsIn(uri, `${path}${name}/`, endings);
    else if (type & vscode.FileType.File && endings.some((ending) => name.toLowerCase().endsWith(ending))) yield [`${path}${name}`, uri];
  }
}

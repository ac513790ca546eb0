/** Files as users, VS Code and the WebAssembly module name them. */
import * as vscode from 'vscode';
import { isComplete, isUri, placeOf } from './module/names';

export const nameOf = ({ path }: vscode.Uri) => path.slice(path.lastIndexOf('/') + 1);

/** The file that has a path in the module. */
export const uriOfPath = (path: string) => vscode.Uri.from(placeOf(path));

/** The file that a user or VS Code names: by a URI, a path in the module, or a path, also one from the workspace's folder. */
export function uriOf(text: string): vscode.Uri {
  if (isUri(text)) return vscode.Uri.parse(text);
  if (text.startsWith('/@')) return uriOfPath(text);
  const folder = vscode.workspace.workspaceFolders?.[0]?.uri;
  if (!isComplete(text)) return vscode.Uri.joinPath(folder ?? vscode.Uri.file('/'), text.replaceAll('\\', '/'));
  // VS Code names files of all schemes by their paths alone.
  const open = vscode.workspace.textDocuments.find(({ uri, fileName }) => fileName === text && uri.scheme !== 'git');
  return open?.uri ?? (folder && folder.scheme !== 'file' ? folder.with({ path: text }) : vscode.Uri.file(text));
}

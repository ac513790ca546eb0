/** Files as Git has them, by the Git extension that comes with VS Code. */
import * as vscode from 'vscode';
import { nameOf } from '../files';

/** What we take of the API of vscode.git, version 1. */
interface Repository {
  show(ref: string, path: string): Promise<string>;
}
interface Api {
  readonly state: 'uninitialized' | 'initialized';
  readonly onDidChangeState: vscode.Event<'uninitialized' | 'initialized'>;
  getRepository(uri: vscode.Uri): Repository | null;
  toGitUri(uri: vscode.Uri, ref: string): vscode.Uri;
}
interface GitExtension {
  readonly enabled: boolean;
  getAPI(version: 1): Api;
}

export interface Version {
  uri: vscode.Uri;
  text: string;
}

/** How long the Git extension may take to look for repositories, in ms. */
const patience = 10_000;

async function api(): Promise<Api | null> {
  const extension = vscode.extensions.getExtension<GitExtension>('vscode.git');
  const git = extension && (extension.isActive ? extension.exports : await extension.activate());
  if (!git?.enabled) return null;
  const found = git.getAPI(1);
  if (found.state !== 'initialized')
    await new Promise<void>((done) => {
      const end = () => {
        clearTimeout(timer);
        subscription.dispose();
        done();
      };
      const timer = setTimeout(end, patience);
      const subscription = found.onDidChangeState(end);
    });
  return found;
}

/** The file in the last commit. Throws, with a message for users, where there is none. */
export async function headOf(file: vscode.Uri): Promise<Version> {
  const git = await api().catch(() => null);
  if (!git) throw new Error(vscode.l10n.t('There is no HEAD here: the Git extension of VS Code does not run.'));
  const repository = file.scheme === 'file' ? git.getRepository(file) : null;
  if (!repository) throw new Error(vscode.l10n.t('{0} is in no Git repository.', nameOf(file)));
  const text = await repository.show('HEAD', file.fsPath).catch(() => null);
  if (text === null) throw new Error(vscode.l10n.t('HEAD has no {0}: it has never been committed there.', nameOf(file)));
  return { uri: git.toGitUri(file, 'HEAD'), text };
}

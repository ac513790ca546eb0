/** isols is asked what a program does otherwise than another one. */
import type * as vscode from 'vscode';
import { settings } from '../environment';
import type { Server } from '../server';
import type { Comparison } from './comparison';

export interface Answer extends Comparison {
  /** Of the new program's document. */
  version: number;
}

/** Both run under the VGPL of the toolpath. `more` are further parameters of the request. */
export function compare<Result = Answer>(
  server: Server,
  old: vscode.TextDocument,
  now: vscode.TextDocument,
  more: object = {},
  token?: vscode.CancellationToken,
): Promise<Result> {
  // Versions of one file run on one machine; another file may have another isocnc.json above it.
  const isOther = old.uri.scheme === now.uri.scheme && old.uri.path !== now.uri.path;
  const params = {
    textDocument: { uri: now.uri.toString() },
    with: { text: old.getText(), ...(isOther ? { uri: old.uri.toString() } : {}) },
    vgpl: settings(now).get('toolpath.vgpl', 0),
    ...more,
  };
  return server.request<Result>('isocnc/compare', params, token);
}

/** Diff editors, whoever has opened them. */
import * as vscode from 'vscode';

/** The diffs that are in front, by the new program. */
export function shownDiffs(): Map<string, vscode.TabInputTextDiff> {
  const inputs = vscode.window.tabGroups.all.map(({ activeTab }) => activeTab?.input);
  const diffs = inputs.filter((input): input is vscode.TabInputTextDiff => input instanceof vscode.TabInputTextDiff);
  return new Map(diffs.map((diff) => [diff.modified.toString(), diff]));
}

export const isInDiff = ({ uri }: vscode.TextDocument) =>
  [...shownDiffs().values()].some(({ original, modified }) => [original, modified].some((each) => each.toString() === uri.toString()));

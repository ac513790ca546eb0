/** What a view takes to show the old program of a diff beside the new one. */
import * as vscode from 'vscode';
import type { ComparisonFacts } from '../../../toolpath-view/src/comparison';
import { applied, received, type SentToolpath } from '../../../toolpath-view/src/streams';
import type { Server } from '../server';
import type { Overlay } from '../toolpath/messages';
import { compare, type Answer } from './comparing';
import { shownDiffs } from './diffs';

interface OverlayAnswer extends Answer {
  overlay: { old: SentToolpath; facts: ComparisonFacts; alignment: string };
}

/** Of the diff in front that has this program as its new one, as long as the program has this version. Null where there is none. */
export async function overlayOf(
  server: Server,
  { uri, version }: vscode.TextDocument,
  bytesOf: (base64: string) => Uint8Array,
  token: vscode.CancellationToken,
): Promise<Overlay | null> {
  const diff = shownDiffs().get(uri.toString());
  if (!diff) return null;
  const [old, now] = await Promise.all([diff.original, diff.modified].map((each) => vscode.workspace.openTextDocument(each)));
  if (old.languageId !== 'isocnc') return null;
  const answer = await compare<OverlayAnswer>(server, old, now, { overlay: true }, token);
  if (answer.version !== version) return null;
  const { overlay } = answer;
  return { old: applied(null, overlay.old.facts, received(overlay.old, bytesOf)), facts: overlay.facts, alignment: bytesOf(overlay.alignment) };
}

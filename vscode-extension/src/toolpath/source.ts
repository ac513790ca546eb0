/** Toolpaths of open programs, as isols works them out: asked for again after each edit. */
import * as vscode from 'vscode';
import { secondsOf, type Recording } from '../../../toolpath-view/src/toolpath';
import { overlayOf } from '../behavior/overlay';
import { settings } from '../environment';
import type { Server } from '../server';
import type { Overlay } from './messages';
import { applied, received, streamNames, type Patches, type SentToolpath } from '../../../toolpath-view/src/streams';

/** How long to wait for another edit. */
const delay = 120;

/** The bytes of base64; Node.js is much faster with long ones. */
const bytesOf = (base64: string) =>
  typeof Buffer === 'undefined' ? Uint8Array.from(atob(base64), (each) => each.charCodeAt(0)) : new Uint8Array(Buffer.from(base64, 'base64'));

export interface KnownToolpath extends Recording {
  uri: vscode.Uri;
  resultId: string;
  version: number;
  seconds: number;
  /** How it differs from the one with this result; null is from nothing. */
  previousResultId: string | null;
  patches: Patches;
}

interface Watched {
  document: vscode.TextDocument;
  owners: Set<object>;
  known: KnownToolpath | null;
  timer: NodeJS.Timeout | null;
  asking: vscode.CancellationTokenSource | null;
}

export class ToolpathSource implements vscode.Disposable {
  private readonly watched = new Map<string, Watched>();
  private readonly updated = new vscode.EventEmitter<KnownToolpath>();
  private readonly failed = new vscode.EventEmitter<{ uri: vscode.Uri; message: string }>();
  private readonly subscriptions: vscode.Disposable[];

  readonly onUpdate = this.updated.event;
  readonly onFailure = this.failed.event;

  constructor(private readonly server: Server) {
    this.subscriptions = [
      vscode.workspace.onDidChangeTextDocument(({ document, contentChanges }) => {
        const watched = this.watched.get(document.uri.toString());
        if (watched && contentChanges.length > 0) this.askSoon(watched);
      }),
      vscode.workspace.onDidCloseTextDocument((document) => this.forget(document.uri.toString())),
      vscode.workspace.onDidChangeConfiguration((change) => {
        if (change.affectsConfiguration('isocnc.toolpath.vgpl')) this.askAgain();
      }),
      vscode.workspace.onDidSaveTextDocument((document) => {
        if (/(isocnc|\.setup)\.json$/.test(document.fileName)) this.askAgain();
      }),
      server.onState((state) => {
        if (state === 'running' || state === 'outdated') this.askAgain();
      }),
      this.updated,
      this.failed,
    ];
  }

  /** From now on this owner wants to know of this document, and of no other. */
  watch(owner: object, document: vscode.TextDocument | null): void {
    const wanted = document?.uri.toString();
    for (const [uri, { owners }] of this.watched)
      if (uri !== wanted && owners.delete(owner) && owners.size === 0) this.forget(uri);
    if (!document || !wanted) return;
    const watched = this.watched.get(wanted) ?? { document, owners: new Set(), known: null, timer: null, asking: null };
    watched.owners.add(owner);
    if (this.watched.has(wanted)) return;
    this.watched.set(wanted, watched);
    void this.ask(watched);
  }

  latest(uri: vscode.Uri): KnownToolpath | null {
    return this.watched.get(uri.toString())?.known ?? null;
  }

  /** What a view takes to show the old program beside this one, of the diff in front, at this version; null where there is none. */
  overlay(document: vscode.TextDocument, token: vscode.CancellationToken): Promise<Overlay | null> {
    return overlayOf(this.server, document, bytesOf, token).catch(() => null);
  }

  dispose(): void {
    for (const uri of [...this.watched.keys()]) this.forget(uri);
    for (const each of this.subscriptions) each.dispose();
  }

  private forget(uri: string): void {
    const watched = this.watched.get(uri);
    if (!watched) return;
    if (watched.timer) clearTimeout(watched.timer);
    watched.asking?.cancel();
    this.watched.delete(uri);
  }

  private askAgain(): void {
    for (const each of this.watched.values()) this.askSoon(each);
  }

  private askSoon(watched: Watched): void {
    if (watched.timer) clearTimeout(watched.timer);
    watched.timer = setTimeout(() => void this.ask(watched), delay);
  }

  private async ask(watched: Watched): Promise<void> {
    const { document, known } = watched;
    watched.asking?.cancel();
    const asking = (watched.asking = new vscode.CancellationTokenSource());
    try {
      const params = {
        textDocument: { uri: document.uri.toString() },
        previousResultId: known?.resultId,
        vgpl: settings(document).get('toolpath.vgpl', 0),
      };
      const sent = await this.server.request<SentToolpath>('isocnc/toolpath', params, asking.token);
      if (!asking.token.isCancellationRequested) this.take(watched, sent);
    } catch (error) {
      if (!asking.token.isCancellationRequested) this.fail(watched, error as Error & { code?: number });
    } finally {
      if (watched.asking === asking) watched.asking = null;
      asking.dispose();
    }
  }

  private take(watched: Watched, sent: SentToolpath): void {
    const patches = received(sent, bytesOf);
    const recording = applied(watched.known, sent.facts, patches);
    const previousResultId = streamNames.some((name) => sent[name]?.start !== undefined) ? watched.known!.resultId : null;
    watched.known = {
      ...recording,
      uri: watched.document.uri,
      resultId: sent.resultId,
      version: sent.version,
      seconds: secondsOf(recording),
      previousResultId,
      patches,
    };
    this.updated.fire(watched.known);
  }

  private fail(watched: Watched, error: Error & { code?: number }): void {
    const [methodNotFound, contentModified, serverCancelled] = [-32601, -32801, -32802];
    // An edit has overtaken the question: another one is on its way.
    if (error.code === contentModified) return;
    if (error.code === serverCancelled) return this.askSoon(watched);
    const isOld = error.code === methodNotFound;
    const message = isOld ? vscode.l10n.t('This isols is too old to draw toolpaths.') : error.message;
    this.failed.fire({ uri: watched.document.uri, message });
  }
}

/** Lines whose path the panel does not show. The tree of operations chooses them. */
import * as vscode from 'vscode';
import type { Lines } from '../operations/operations';

export class HiddenLines implements vscode.Disposable {
  private readonly changed = new vscode.EventEmitter<string>();
  private readonly lines = new Map<string, Lines[]>();

  /** With the URI of the program. */
  readonly onChange = this.changed.event;

  of(program: vscode.Uri): Lines[] {
    return this.lines.get(program.toString()) ?? [];
  }

  set(program: vscode.Uri, lines: Lines[]): void {
    if (JSON.stringify(lines) === JSON.stringify(this.of(program))) return;
    this.lines.set(program.toString(), lines);
    this.changed.fire(program.toString());
  }

  dispose(): void {
    this.changed.dispose();
  }
}

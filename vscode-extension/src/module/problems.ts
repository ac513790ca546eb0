/**
 * What isolint reports, as problems of files that are not on this computer: VS Code's problem matchers know no others. The lines are
 * read by the same patterns.
 */
import * as vscode from 'vscode';
import { uriOfPath } from '../files';

interface Pattern {
  regexp: string;
  file: number;
  line: number;
  column: number;
  severity?: number;
  message: number;
  code: number;
}

interface Matcher {
  severity?: string;
  pattern: string | Pattern;
}

export interface Contributions {
  problemPatterns: (Pattern & { name: string })[];
  problemMatchers: Matcher[];
}

const severities: Record<string, vscode.DiagnosticSeverity> = {
  error: vscode.DiagnosticSeverity.Error,
  warning: vscode.DiagnosticSeverity.Warning,
  info: vscode.DiagnosticSeverity.Information,
};

export class Problems {
  private readonly collection = vscode.languages.createDiagnosticCollection('isolint');

  constructor(private readonly contributions: Contributions) {}

  /** Those of the last check; `folder` is where it ran, a path in the module. */
  show(output: string, folder: string): void {
    const found = new Map<string, vscode.Diagnostic[]>();
    for (const line of output.split('\n')) {
      const read = this.read(line);
      if (!read) continue;
      const path = read.file.startsWith('/') ? read.file : `${folder}/${read.file}`;
      found.set(path, [...(found.get(path) ?? []), read.diagnostic]);
    }
    this.collection.clear();
    const isOpen = (uri: vscode.Uri) => vscode.workspace.textDocuments.some((document) => document.uri.toString() === uri.toString());
    for (const [path, diagnostics] of found) {
      const uri = uriOfPath(path);
      // The server reports what is open.
      if (!isOpen(uri)) this.collection.set(uri, diagnostics);
    }
  }

  forget(uri: vscode.Uri): void {
    this.collection.delete(uri);
  }

  dispose(): void {
    this.collection.dispose();
  }

  private read(line: string): { file: string; diagnostic: vscode.Diagnostic } | null {
    for (const { severity, pattern } of this.contributions.problemMatchers) {
      const known = typeof pattern === 'string' ? this.contributions.problemPatterns.find(({ name }) => `$${name}` === pattern) : pattern;
      const found = known && new RegExp(known.regexp).exec(line);
      if (!found) continue;
      const place = new vscode.Position(Number(found[known.line]) - 1, Number(found[known.column]) - 1);
      const kind = known.severity === undefined ? severity : found[known.severity];
      const diagnostic = new vscode.Diagnostic(new vscode.Range(place, place), found[known.message], severities[kind ?? 'error']);
      diagnostic.code = found[known.code];
      diagnostic.source = 'isolint';
      return { file: found[known.file], diagnostic };
    }
    return null;
  }
}

/** The editor: the program, its marks, and where the machine is. */
import { languageId, registerDialect, themeName } from './dialect';
import { editsOf } from './language_server';
import * as monaco from './monaco';
import type { Theme } from './preferences';
import type { CodeAction, Diagnostic } from './protocol';
import { markerOf, rangeOf, toServer } from './providers';

export interface Edit {
  changes: { range: ReturnType<typeof toServer>; text: string }[];
}

export class ProgramEditor {
  /** The program has changed; the ranges are of the program before. */
  onEdit: (edit: Edit) => void = () => undefined;
  /** Lines that are selected, from 0; `last` belongs to them. */
  onSelect: (first: number, last: number) => void = () => undefined;
  onBreakpoints: () => void = () => undefined;

  private readonly editor: monaco.editor.IStandaloneCodeEditor;
  private readonly model: monaco.editor.ITextModel;
  private readonly passing: monaco.editor.IEditorDecorationsCollection;
  private readonly standing: monaco.editor.IEditorDecorationsCollection;
  private readonly breakpoints: monaco.editor.IEditorDecorationsCollection;
  /** A line that the page itself has gone to. */
  private isFollowing = false;

  constructor(container: HTMLElement, text: string, theme: Theme, label: string) {
    registerDialect();
    this.model = monaco.editor.createModel(text, languageId, monaco.Uri.parse('file:///program/program.iso'));
    this.editor = monaco.editor.create(container, {
      model: this.model,
      theme: themeName(theme),
      ariaLabel: label,
      automaticLayout: true,
      fontSize: 13,
      fontFamily: "ui-monospace, 'Cascadia Mono', 'SF Mono', Menlo, Consolas, 'DejaVu Sans Mono', monospace",
      minimap: { enabled: false },
      glyphMargin: true,
      lineNumbersMinChars: 3,
      folding: true,
      scrollBeyondLastLine: false,
      fixedOverflowWidgets: true,
      wordBasedSuggestions: 'off',
      occurrencesHighlight: 'singleFile',
      'semanticHighlighting.enabled': true,
      unicodeHighlight: { ambiguousCharacters: false, invisibleCharacters: false, nonBasicASCII: false },
      bracketPairColorization: { enabled: false },
      padding: { top: 6, bottom: 6 },
      stickyScroll: { enabled: false },
      inlayHints: { enabled: 'on', fontSize: 11 },
      quickSuggestions: { other: true, comments: false, strings: false },
      // Tab leads on to the findings, and keys alone reach everything.
      tabFocusMode: true,
    });
    this.passing = this.editor.createDecorationsCollection();
    this.standing = this.editor.createDecorationsCollection();
    this.breakpoints = this.editor.createDecorationsCollection();
    this.listen();
    this.color();
  }

  get text(): string {
    return this.model.getValue();
  }

  /** Replaces the whole program; the way back is Undo. */
  replace(text: string): void {
    this.editor.pushUndoStop();
    this.model.pushEditOperations([], [{ range: this.model.getFullModelRange(), text }], () => null);
    this.model.setEOL(text.includes('\r\n') ? monaco.editor.EndOfLineSequence.CRLF : monaco.editor.EndOfLineSequence.LF);
    this.editor.pushUndoStop();
    this.color();
    this.breakpoints.clear();
    this.onBreakpoints();
    this.go(0);
  }

  apply(edits: readonly { range: monaco.IRange; text: string }[]): void {
    this.editor.pushUndoStop();
    this.editor.executeEdits('isols', edits.map((edit) => ({ ...edit, forceMoveMarkers: true })));
    this.editor.pushUndoStop();
  }

  applyFix({ edit }: CodeAction): void {
    this.apply(editsOf(edit).map(({ range, newText }) => ({ range: rangeOf(range), text: newText })));
  }

  show(findings: readonly Diagnostic[]): void {
    monaco.editor.setModelMarkers(this.model, 'isols', findings.map((each) => markerOf(each, this.model)));
  }

  /** Goes to a place, from 0. */
  go(line: number, column = 0): void {
    const place = this.model.validatePosition({ lineNumber: line + 1, column: column + 1 });
    this.editor.setPosition(place);
    this.editor.revealPositionInCenterIfOutsideViewport(place);
  }

  focus(): void {
    this.editor.focus();
  }

  /** Goes to a line without telling anybody. */
  follow(line: number): void {
    this.isFollowing = true;
    this.go(line);
    this.isFollowing = false;
  }

  /** Marks the line that the tool passes; -1 is none. */
  pass(line: number): void {
    this.mark(this.passing, line, { isWholeLine: true, className: 'passing' });
  }

  /** Marks the line before which the machine stands; null is none. */
  stand(line: number | null): void {
    this.pass(-1);
    this.mark(this.standing, line ?? -1, { isWholeLine: true, className: 'standing', glyphMarginClassName: 'standing-glyph' });
  }

  setTheme(theme: Theme): void {
    monaco.editor.setTheme(themeName(theme));
  }

  setLabel(label: string): void {
    this.editor.updateOptions({ ariaLabel: label });
  }

  /** Colors the start of the program at once: Monaco does so when the page is idle, which a slow machine that draws a path is late. */
  private color(): void {
    const { tokenization } = this.model as unknown as { tokenization?: { forceTokenization(line: number): void } };
    tokenization?.forceTokenization(Math.min(this.model.getLineCount(), 200));
  }

  private mark(marks: monaco.editor.IEditorDecorationsCollection, line: number, options: monaco.editor.IModelDecorationOptions): void {
    if (line < 0 || line >= this.model.getLineCount()) return marks.clear();
    marks.set([{ range: new monaco.Range(line + 1, 1, line + 1, 1), options }]);
    this.editor.revealLineInCenterIfOutsideViewport(line + 1);
  }

  private listen(): void {
    this.model.onDidChangeContent(({ changes }) =>
      this.onEdit({ changes: changes.map(({ range, text }) => ({ range: toServer(range), text })) }),
    );
    this.editor.onDidChangeCursorSelection(({ selection }) => {
      if (this.isFollowing) return;
      this.pass(-1);
      const { startLineNumber, endLineNumber, endColumn } = selection;
      // A selection that ends before a line's first character does not hold that line.
      const last = endColumn === 1 && endLineNumber > startLineNumber ? endLineNumber - 1 : endLineNumber;
      this.onSelect(startLineNumber - 1, last - 1);
    });
    this.editor.onMouseDown(({ target }) => {
      const { GUTTER_GLYPH_MARGIN, GUTTER_LINE_NUMBERS } = monaco.editor.MouseTargetType;
      if (target.type === GUTTER_GLYPH_MARGIN || target.type === GUTTER_LINE_NUMBERS) this.toggleBreakpoint(target.position.lineNumber);
    });
    this.editor.addCommand(monaco.KeyCode.F9, () => this.toggleBreakpoint(this.editor.getPosition()?.lineNumber ?? 1));
  }

  /** Lines, from 1. */
  get breakpointLines(): number[] {
    const lines = this.breakpoints.getRanges().map(({ startLineNumber }) => startLineNumber);
    return lines.sort((one, other) => one - other);
  }

  private toggleBreakpoint(line: number): void {
    const lines = this.breakpointLines;
    const wanted = lines.includes(line) ? lines.filter((each) => each !== line) : [...lines, line];
    this.breakpoints.set(
      wanted.map((each) => ({ range: new monaco.Range(each, 1, each, 1), options: { glyphMarginClassName: 'breakpoint', stickiness: monaco.editor.TrackedRangeStickiness.NeverGrowsWhenTypingAtEdges } })),
    );
    this.onBreakpoints();
  }
}

/** What the page uses of the language server protocol. */

export interface Position {
  line: number;
  character: number;
}

export interface Range {
  start: Position;
  end: Position;
}

export interface TextEdit {
  range: Range;
  newText: string;
}

export interface Diagnostic {
  range: Range;
  /** 1 error, 2 warning, 3 information, 4 hint. */
  severity: 1 | 2 | 3 | 4;
  code?: string;
  message: string;
  tags?: number[];
  relatedInformation?: { location: { uri: string; range: Range }; message: string }[];
  codeDescription?: { href: string };
  data?: unknown;
}

export interface WorkspaceEdit {
  changes?: Record<string, TextEdit[]>;
}

export interface CodeAction {
  title: string;
  kind: string;
  isPreferred?: boolean;
  diagnostics?: Diagnostic[];
  edit?: WorkspaceEdit;
  data?: unknown;
}

export interface CompletionItem {
  label: string;
  kind?: number;
  detail?: string;
  documentation?: string | { value: string };
  sortText?: string;
  filterText?: string;
  insertTextFormat?: 1 | 2;
  textEdit?: TextEdit;
  insertText?: string;
  data?: unknown;
}

export interface Hover {
  contents: { value: string };
  range?: Range;
}

export interface Location {
  uri: string;
  range: Range;
}

export interface InlayHint {
  position: Position;
  label: string | { value: string }[];
  paddingLeft?: boolean;
  paddingRight?: boolean;
  tooltip?: string | { value: string };
}

export interface SignatureHelp {
  signatures: { label: string; documentation?: string | { value: string }; parameters?: { label: string | [number, number]; documentation?: string | { value: string } }[]; activeParameter?: number }[];
  activeSignature?: number;
  activeParameter?: number;
}

export interface SemanticTokens {
  data: number[];
}

export interface Capabilities {
  semanticTokensProvider?: { legend: { tokenTypes: string[]; tokenModifiers: string[] } };
  completionProvider?: { triggerCharacters?: string[] };
  signatureHelpProvider?: { triggerCharacters?: string[] };
}

/** The bridge from Monaco's providers to the requests of isols. */
import { languageId } from './dialect';
import { editsOf, RequestError, textDocument, type LanguageServer } from './language_server';
import * as monaco from './monaco';
import type * as lsp from './protocol';

export const rangeOf = ({ start, end }: lsp.Range): monaco.IRange => ({
  startLineNumber: start.line + 1,
  startColumn: start.character + 1,
  endLineNumber: end.line + 1,
  endColumn: end.character + 1,
});
export const toServer = (range: monaco.IRange): lsp.Range => ({
  start: { line: range.startLineNumber - 1, character: range.startColumn - 1 },
  end: { line: range.endLineNumber - 1, character: range.endColumn - 1 },
});
const place = ({ lineNumber, column }: monaco.IPosition): lsp.Position => ({ line: lineNumber - 1, character: column - 1 });
const markdown = (text: string | { value: string } | undefined) => (typeof text === 'string' ? text : text && { value: text.value });

const severities = [monaco.MarkerSeverity.Error, monaco.MarkerSeverity.Warning, monaco.MarkerSeverity.Info, monaco.MarkerSeverity.Hint];

export function markerOf(diagnostic: lsp.Diagnostic, model: monaco.editor.ITextModel): monaco.editor.IMarkerData {
  return {
    ...rangeOf(diagnostic.range),
    severity: severities[diagnostic.severity - 1],
    message: diagnostic.message,
    code: diagnostic.code,
    tags: diagnostic.tags,
    relatedInformation: diagnostic.relatedInformation?.map(({ location, message }) => ({
      ...rangeOf(location.range),
      resource: model.uri,
      message,
    })),
  };
}

/** `findings` are those shown at present. */
export function registerProviders(server: LanguageServer, capabilities: lsp.Capabilities, findings: () => readonly lsp.Diagnostic[]): void {
  /** The answer; nothing where an edit has overtaken the request. */
  const ask = async <Result>(method: string, params: object, token: monaco.CancellationToken): Promise<Result | null> => {
    const controller = new AbortController();
    const cancelling = token.onCancellationRequested(() => controller.abort());
    try {
      return await server.request<Result | null>(method, { textDocument, ...params }, controller.signal);
    } catch (error) {
      if (error instanceof RequestError && error.isOutdated) return null;
      throw error;
    } finally {
      cancelling.dispose();
    }
  };
  const { languages } = monaco;

  languages.registerHoverProvider(languageId, {
    provideHover: async (_, position, token) => {
      const hover = await ask<lsp.Hover>('textDocument/hover', { position: place(position) }, token);
      return hover && { contents: [{ value: hover.contents.value }], range: hover.range && rangeOf(hover.range) };
    },
  });

  languages.registerCompletionItemProvider(languageId, {
    triggerCharacters: capabilities.completionProvider?.triggerCharacters,
    provideCompletionItems: async (model, position, context, token) => {
      const params = { position: place(position), context: { triggerKind: context.triggerKind + 1, triggerCharacter: context.triggerCharacter } };
      const answer = await ask<lsp.CompletionItem[] | { items: lsp.CompletionItem[] }>('textDocument/completion', params, token);
      const items = (Array.isArray(answer) ? answer : answer?.items) ?? [];
      const word = model.getWordUntilPosition(position);
      const here = { startLineNumber: position.lineNumber, endLineNumber: position.lineNumber, startColumn: word.startColumn, endColumn: position.column };
      return { suggestions: items.map((item) => suggestionOf(item, here)) };
    },
    resolveCompletionItem: async (suggestion, token) => {
      const item = sources.get(suggestion);
      if (item?.data === undefined) return suggestion;
      const resolved = await ask<lsp.CompletionItem>('completionItem/resolve', item, token);
      return { ...suggestion, documentation: markdown(resolved?.documentation) };
    },
  });

  languages.registerSignatureHelpProvider(languageId, {
    signatureHelpTriggerCharacters: capabilities.signatureHelpProvider?.triggerCharacters,
    provideSignatureHelp: async (_, position, token) => {
      const help = await ask<lsp.SignatureHelp>('textDocument/signatureHelp', { position: place(position) }, token);
      if (!help) return null;
      const signatures = help.signatures.map((signature) => ({
        ...signature,
        documentation: markdown(signature.documentation),
        parameters: (signature.parameters ?? []).map((parameter) => ({ ...parameter, documentation: markdown(parameter.documentation) })),
      }));
      return {
        value: { signatures, activeSignature: help.activeSignature ?? 0, activeParameter: help.activeParameter ?? 0 },
        dispose: () => undefined,
      };
    },
  });

  const actions = new WeakMap<monaco.languages.CodeAction, lsp.CodeAction>();
  languages.registerCodeActionProvider(
    languageId,
    {
      provideCodeActions: async (model, range, context, token) => {
        const wanted = toServer(range);
        const touches = ({ start, end }: lsp.Range) => start.line <= wanted.end.line && end.line >= wanted.start.line;
        const diagnostics = findings().filter((each) => touches(each.range));
        const params = { range: wanted, context: { diagnostics, only: context.only ? [context.only] : undefined } };
        const answer = (await ask<lsp.CodeAction[]>('textDocument/codeAction', params, token)) ?? [];
        const made = answer.map((action) => {
          const shown: monaco.languages.CodeAction = {
            title: action.title,
            kind: action.kind,
            isPreferred: action.isPreferred,
            diagnostics: action.diagnostics?.map((each) => markerOf(each, model)),
            edit: action.edit && workspaceEdit(model, action.edit),
          };
          actions.set(shown, action);
          return shown;
        });
        return { actions: made, dispose: () => undefined };
      },
      resolveCodeAction: async (shown, token) => {
        const action = actions.get(shown);
        const [model] = monaco.editor.getModels();
        if (!action || action.edit) return shown;
        const resolved = await ask<lsp.CodeAction>('codeAction/resolve', action, token);
        return { ...shown, edit: resolved?.edit && workspaceEdit(model, resolved.edit) };
      },
    },
    { providedCodeActionKinds: ['quickfix', 'refactor', 'source'] },
  );

  const legend = capabilities.semanticTokensProvider?.legend;
  if (legend)
    languages.registerDocumentSemanticTokensProvider(languageId, {
      getLegend: () => legend,
      provideDocumentSemanticTokens: async (_model, _last, token) => {
        const tokens = await ask<lsp.SemanticTokens>('textDocument/semanticTokens/full', {}, token);
        return tokens && { data: Uint32Array.from(tokens.data) };
      },
      releaseDocumentSemanticTokens: () => undefined,
    });

  languages.registerInlayHintsProvider(languageId, {
    provideInlayHints: async (_, range, token) => {
      const hints = (await ask<lsp.InlayHint[]>('textDocument/inlayHint', { range: toServer(range) }, token)) ?? [];
      const shown = hints.map(({ position, label, paddingLeft, paddingRight, tooltip }) => ({
        position: { lineNumber: position.line + 1, column: position.character + 1 },
        label: typeof label === 'string' ? label : label.map(({ value }) => value).join(''),
        paddingLeft,
        paddingRight,
        tooltip: markdown(tooltip),
      }));
      return { hints: shown, dispose: () => undefined };
    },
  });

  languages.registerFoldingRangeProvider(languageId, {
    provideFoldingRanges: async (_model, _context, token) => {
      const ranges = (await ask<{ startLine: number; endLine: number }[]>('textDocument/foldingRange', {}, token)) ?? [];
      return ranges.map(({ startLine, endLine }) => ({ start: startLine + 1, end: endLine + 1 }));
    },
  });

  const locations = (answer: lsp.Location | lsp.Location[] | null, model: monaco.editor.ITextModel) =>
    (Array.isArray(answer) ? answer : answer ? [answer] : []).map(({ range }) => ({ uri: model.uri, range: rangeOf(range) }));
  languages.registerDefinitionProvider(languageId, {
    provideDefinition: async (model, position, token) =>
      locations(await ask('textDocument/definition', { position: place(position) }, token), model),
  });
  languages.registerDocumentHighlightProvider(languageId, {
    provideDocumentHighlights: async (_, position, token) =>
      (await ask<lsp.Location[]>('textDocument/documentHighlight', { position: place(position) }, token))?.map(({ range }) => ({ range: rangeOf(range) })) ?? [],
  });

  languages.registerRenameProvider(languageId, {
    provideRenameEdits: async (model, position, newName, token) => {
      try {
        const edit = await ask<lsp.WorkspaceEdit>('textDocument/rename', { position: place(position), newName }, token);
        return edit && workspaceEdit(model, edit);
      } catch (error) {
        return { edits: [], rejectReason: (error as Error).message };
      }
    },
  });
}

const sources = new WeakMap<monaco.languages.CompletionItem, lsp.CompletionItem>();

/** Both protocols number their kinds, differently. */
function kindOf(kind: number | undefined): monaco.languages.CompletionItemKind {
  const { CompletionItemKind } = monaco.languages;
  const kinds: Record<number, monaco.languages.CompletionItemKind> = {
    2: CompletionItemKind.Method,
    3: CompletionItemKind.Function,
    5: CompletionItemKind.Field,
    6: CompletionItemKind.Variable,
    7: CompletionItemKind.Class,
    10: CompletionItemKind.Property,
    12: CompletionItemKind.Value,
    14: CompletionItemKind.Keyword,
    15: CompletionItemKind.Snippet,
    18: CompletionItemKind.Reference,
    21: CompletionItemKind.Constant,
    24: CompletionItemKind.Operator,
  };
  return kinds[kind ?? 14] ?? CompletionItemKind.Keyword;
}

function suggestionOf(item: lsp.CompletionItem, here: monaco.IRange): monaco.languages.CompletionItem {
  const made: monaco.languages.CompletionItem = {
    label: item.label,
    kind: kindOf(item.kind),
    detail: item.detail,
    documentation: markdown(item.documentation),
    sortText: item.sortText,
    filterText: item.filterText,
    insertText: item.textEdit?.newText ?? item.insertText ?? item.label,
    insertTextRules: item.insertTextFormat === 2 ? monaco.languages.CompletionItemInsertTextRule.InsertAsSnippet : undefined,
    range: item.textEdit ? rangeOf(item.textEdit.range) : here,
  };
  sources.set(made, item);
  return made;
}

function workspaceEdit(model: monaco.editor.ITextModel, edit: lsp.WorkspaceEdit): monaco.languages.WorkspaceEdit {
  return {
    edits: editsOf(edit).map(({ range, newText }) => ({
      resource: model.uri,
      versionId: model.getVersionId(),
      textEdit: { range: rangeOf(range), text: newText },
    })),
  };
}

/** The dialect as Monaco colors it: at once by its words, a moment later by what isols knows of them. Both have the same names. */
import * as monaco from './monaco';
import type { Theme } from './preferences';

export const languageId = 'isocnc';

/** As syntaxes/isocnc.tmLanguage.json of the extension, with the token names of isols. */
const words: monaco.languages.IMonarchLanguage = {
  ignoreCase: true,
  tokenizer: {
    root: [
      [/;.*$/, 'comment'],
      [/\([^)]*\)?/, 'comment'],
      [/G\s*O\s*T\s*O/, { token: 'keyword', next: '@label' }],
      [/I\s*F(?![A-Z])/, 'keyword'],
      [/V\s*G\s*P\s*L/, 'variable'],
      [/<>|<=|>=|[=<>]/, 'operator'],
      [/N\s*\d+(?:[ \t]+\d+)*/, 'decorator'],
      [/V\s*\d+/, 'variable'],
      [/G\s*0*[0-3](?![\d.])/, 'function'],
      [/G\s*\d+/, 'macro'],
      [/M\s*\d+/, 'method'],
      [/T\s*\d+(?:[ \t]+\d+)*/, 'class'],
      [/[FS]/, { token: 'property' }],
      [/P\s*\d+(?=\s*=)/, 'parameter'],
      [/[XYZABCIJKRPQ]/, 'parameter'],
      [/[-+]?\s*(?:\d[\d \t]*\.?\d*|\.\s*\d+)/, 'number'],
    ],
    label: [
      [/\s+/, ''],
      [/N\s*\d+/, { token: 'decorator', next: '@pop' }],
      [/(?=.)/, { token: '', next: '@pop' }],
      [/$/, { token: '', next: '@pop' }],
    ],
  },
};

/** Colors of the tokens of isols; contrast 4.5 and more on the backgrounds of playground.css. */
const colors: Record<Theme, Record<string, string>> = {
  light: {
    function: '0b57a4',
    macro: '7a3e9d',
    method: '8a4b00',
    class: '00695c',
    parameter: '37474f',
    property: '8a4b00',
    number: '1b5e20',
    variable: 'a3005c',
    decorator: '667080',
    keyword: 'a3005c',
    operator: '37474f',
    comment: '4f7457',
  },
  dark: {
    function: '7cc4ff',
    macro: 'd3a6f2',
    method: 'f0b878',
    class: '6fdcc4',
    parameter: 'c3cad5',
    property: 'f0b878',
    number: 'b5dca0',
    variable: 'ff9ccb',
    decorator: '98a2b1',
    keyword: 'ff9ccb',
    operator: 'c3cad5',
    comment: '86b08f',
  },
};

const surfaces: Record<Theme, monaco.editor.IColors> = {
  light: {
    'editor.background': '#ffffff',
    'editor.foreground': '#1d2129',
    'editorLineNumber.foreground': '#7b8492',
    'editorLineNumber.activeForeground': '#1d2129',
    'editor.lineHighlightBackground': '#f2f4f8',
    'editorInlayHint.foreground': '#5c6675',
    'editorInlayHint.background': '#eef1f5',
    'editorUnnecessaryCode.opacity': '#000000b0',
  },
  dark: {
    'editor.background': '#1a1e25',
    'editor.foreground': '#e6e9ee',
    'editorLineNumber.foreground': '#7f8896',
    'editorLineNumber.activeForeground': '#e6e9ee',
    'editor.lineHighlightBackground': '#232933',
    'editorInlayHint.foreground': '#a5aebc',
    'editorInlayHint.background': '#262c36',
    'editorWidget.background': '#1e232b',
    'editorUnnecessaryCode.opacity': '#000000b0',
  },
};

export const themeName = (theme: Theme) => `isocnc-${theme}`;

export function registerDialect(): void {
  monaco.languages.register({ id: languageId, extensions: ['.iso'] });
  monaco.languages.setMonarchTokensProvider(languageId, words);
  monaco.languages.setLanguageConfiguration(languageId, {
    comments: { lineComment: ';', blockComment: ['(', ')'] },
    brackets: [['(', ')']],
    autoClosingPairs: [{ open: '(', close: ')', notIn: ['comment'] }],
    surroundingPairs: [{ open: '(', close: ')' }],
    wordPattern: /[A-Za-z]+[-+]?[0-9]*\.?[0-9]*|[-+]?[0-9]+\.?[0-9]*/,
  });
  for (const theme of ['light', 'dark'] as const)
    monaco.editor.defineTheme(themeName(theme), {
      base: theme === 'dark' ? 'vs-dark' : 'vs',
      inherit: true,
      rules: Object.entries(colors[theme]).map(([token, foreground]) => ({ token, foreground })),
      colors: surfaces[theme],
    });
}

/** Monaco's own texts, which it reads once, when its modules are loaded: this one has to come before them. */
import 'monaco-editor/nls/lang/it';
import { chosenLanguage } from './preferences';

const scope = globalThis as { _VSCODE_NLS_MESSAGES?: unknown; _VSCODE_NLS_LANGUAGE?: unknown };
if (chosenLanguage() === 'en') {
  delete scope._VSCODE_NLS_MESSAGES;
  delete scope._VSCODE_NLS_LANGUAGE;
}

/** VS Code's theme, as a webview gets it: classes of the body, colors as CSS variables. */
import type { Color, Theme } from '../../../toolpath-view/src/colors';

export function themeOf(body: HTMLElement): Theme {
  const { classList } = body;
  if (classList.contains('vscode-high-contrast-light')) return 'contrastLight';
  if (classList.contains('vscode-high-contrast')) return 'contrastDark';
  return classList.contains('vscode-light') ? 'light' : 'dark';
}

/** The editor's own, so that the picture is a part of it. */
export function backgroundOf(body: HTMLElement): Color | undefined {
  const text = getComputedStyle(body).getPropertyValue('--vscode-editor-background').trim();
  const digits = /^#([0-9a-f]{6})/i.exec(text)?.[1];
  if (!digits) return undefined;
  const value = parseInt(digits, 16);
  return [value >> 16, (value >> 8) & 0xff, value & 0xff];
}

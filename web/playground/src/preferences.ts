/** What the reader has chosen, kept in this browser: language and theme. */
import type { Language } from './texts';

export type Theme = 'light' | 'dark';

/** A browser may keep nothing, and says so by an exception. */
function kept(name: string): string | null {
  try {
    return localStorage.getItem(`isocnc.${name}`);
  } catch {
    return null;
  }
}

function keep(name: string, value: string): void {
  try {
    localStorage.setItem(`isocnc.${name}`, value);
  } catch {
    // It holds until the page is closed, then.
  }
}

const isDark = matchMedia('(prefers-color-scheme: dark)');

export function chosenLanguage(): Language {
  const language = kept('language') ?? navigator.language;
  return language.toLowerCase().startsWith('it') ? 'it' : 'en';
}

export function chosenTheme(): Theme {
  const theme = kept('theme');
  if (theme === 'light' || theme === 'dark') return theme;
  return isDark.matches ? 'dark' : 'light';
}

/** Calls `change` when the system changes to dark or light, unless the reader has chosen. */
export function onSystemTheme(change: (theme: Theme) => void): void {
  isDark.addEventListener('change', () => {
    if (kept('theme') === null) change(chosenTheme());
  });
}

export const keepLanguage = (language: Language) => keep('language', language);
export const keepTheme = (theme: Theme) => keep('theme', theme);

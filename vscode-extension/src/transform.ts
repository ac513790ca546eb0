/** Asks how a program is to be mirrored, rotated or shifted, or its feeds changed; the server then does it. */
import * as vscode from 'vscode';
import { numbersOf } from './numbers';

/** The argument of the server's command `isocnc.transform`, without the program. */
export type Transformation = Record<string, string | number | number[]>;

interface Choice extends vscode.QuickPickItem {
  ask(): Promise<Transformation | undefined>;
}

async function ask(prompt: string, placeHolder: string, least: number, most = least): Promise<number[] | undefined> {
  const text = await vscode.window.showInputBox({
    prompt,
    placeHolder,
    validateInput: (value) => (numbersOf(value, least, most) ? null : prompt),
  });
  return text === undefined ? undefined : (numbersOf(text, least, most) ?? undefined);
}

async function mirror(axis: 'X' | 'Y'): Promise<Transformation | undefined> {
  const about = await ask(vscode.l10n.t('{0} of the place to mirror about, in mm, as the program counts', axis), '400', 1);
  return about && { mirror: axis, about: about[0] };
}

async function rotate(): Promise<Transformation | undefined> {
  const degrees = await ask(vscode.l10n.t('Degrees, counterclockwise as seen from above'), '90', 1);
  const about = degrees && (await ask(vscode.l10n.t('X and Y of the center, in mm, as the program counts'), '400, 250', 2));
  return about && { rotate: degrees[0], about };
}

async function shift(): Promise<Transformation | undefined> {
  const by = await ask(vscode.l10n.t('The way in mm along X, Y and, if need be, Z'), '100, -50, 0', 2, 3);
  return by && { shift: by };
}

async function repeat(): Promise<Transformation | undefined> {
  const counts = await ask(vscode.l10n.t('Columns along X and rows along Y'), '3, 2', 2);
  const way = counts && (await ask(vscode.l10n.t('The way in mm from column to column, and from row to row'), '120, 80', 2));
  return way && { repeat: [...counts, ...way] };
}

async function scaleFeed(): Promise<Transformation | undefined> {
  const factor = await ask(vscode.l10n.t('The factor for each F'), '0.8', 1);
  return factor && { scaleFeed: factor[0] };
}

/** What the user wants; undefined if they have changed their mind. */
export async function askForTransformation(): Promise<Transformation | undefined> {
  const choices: Choice[] = [
    { label: vscode.l10n.t('Mirror X'), ask: () => mirror('X') },
    { label: vscode.l10n.t('Mirror Y'), ask: () => mirror('Y') },
    { label: vscode.l10n.t('Rotate'), ask: rotate },
    { label: vscode.l10n.t('Shift'), ask: shift },
    { label: vscode.l10n.t('Repeat'), ask: repeat },
    { label: vscode.l10n.t('Scale feeds'), ask: scaleFeed },
  ];
  return (await vscode.window.showQuickPick(choices))?.ask();
}

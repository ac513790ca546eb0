/** The files that belong to a program without being one: its setup, and the files with shapes that descriptions of surroundings name. */

export const setupEnding = '.setup.json';

/** The setup of `door.iso` is `door.setup.json`. */
export const setupNameOf = (program: string) => program.replace(/(?<=.)\.[^.]*$/, '') + setupEnding;

/**
 * The STL files and stocks that a description names, each as the steps that lead to it from the description's folder. Names that lead
 * elsewhere are left out, as the programs refuse them. What stands in a comment is taken along: a file too many does no harm.
 */
export function shapesIn(description: string): string[][] {
  const found = new Map<string, string[]>();
  for (const [, quoted] of description.matchAll(/"(?:mesh|from)"\s*:\s*("(?:[^"\\\n]|\\.)*")/g)) {
    const steps = stepsOf(text(quoted));
    if (steps) found.set(steps.join('/'), steps);
  }
  return [...found.values()];
}

function text(quoted: string): string {
  try {
    return JSON.parse(quoted) as string;
  } catch {
    return '';
  }
}

function stepsOf(name: string): string[] | null {
  const steps: string[] = [];
  if (name.startsWith('/')) return null;
  for (const step of name.split('/')) {
    if (step === '..' && steps.pop() === undefined) return null;
    if (step !== '' && step !== '.' && step !== '..') steps.push(step);
  }
  return steps.length > 0 ? steps : null;
}

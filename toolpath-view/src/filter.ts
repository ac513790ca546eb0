/** Which part of a path is shown: without some tools, some sections and what is too high or too low. */
import type { Steps, Toolpath } from './toolpath';

/** What the program does with a tool without changing it. */
export interface Section extends Steps {
  /** Of the facts' tools. */
  tool: number;
}

export function sectionsOf(path: Toolpath): Section[] {
  const sections: Section[] = [];
  for (let step = 0; step < path.stepCount; ++step) {
    const last = sections.at(-1);
    if (last?.tool === path.stepTool[step]) last.end = step + 1;
    else sections.push({ start: step, end: step + 1, tool: path.stepTool[step] });
  }
  return sections;
}

export interface Filter {
  /** Names of tools that are hidden; null is no tool. */
  tools: ReadonlySet<string | null>;
  /** Places of hidden sections in the program, from 0. */
  sections: ReadonlySet<number>;
  /** First and last lines, from 0, of which nothing is shown. */
  lines: readonly (readonly [first: number, last: number])[];
  /** Heights of the tip between which moves are shown; machine frame, mm. */
  minZ: number;
  maxZ: number;
}

export const noFilter: Filter = { tools: new Set(), sections: new Set(), lines: [], minZ: -Infinity, maxZ: Infinity };

/** For each step whether a filter hides it; null where it hides none. Heights are left out: they may hide a part of a step. */
export function hiddenSteps(path: Toolpath, { tools, sections, lines }: Filter): Uint8Array | null {
  if (tools.size === 0 && sections.size === 0 && lines.length === 0) return null;
  const hidden = new Uint8Array(path.stepCount);
  sectionsOf(path).forEach(({ start, end, tool }, i) => {
    if (sections.has(i) || tools.has(path.facts.tools[tool].name)) hidden.fill(1, start, end);
  });
  if (lines.length > 0)
    path.stepLine.forEach((line, step) => {
      if (lines.some(([first, last]) => line >= first && line <= last)) hidden[step] = 1;
    });
  return hidden;
}

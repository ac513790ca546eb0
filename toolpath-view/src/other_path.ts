/** The path of another program in the picture of one, with its tool: dotted, so that nobody takes it for the other one. */
import * as THREE from 'three';
import { palettes, stepColors, type Mode, type Theme } from './colors';
import type { Mark } from './comparison';
import { hiddenSteps, type Filter } from './filter';
import { ToolModel } from './furniture';
import { PathLines } from './path_lines';
import { Kind, type Steps, type Toolpath } from './toolpath';

/** What of a path is shown, as the path beside it is. */
export interface ShownParts {
  mode: Mode;
  theme: Theme;
  rapids: boolean;
  filter: Filter;
}

export class OtherPath {
  readonly lines: PathLines;
  readonly tool = new ToolModel();
  private lit: PathLines | null = null;
  private litSteps: Steps | null = null;
  private isMarked = false;
  private parts: ShownParts | null = null;
  private hidden: Uint8Array | null = null;

  constructor(
    readonly path: Toolpath,
    private readonly markOf: (step: number) => Mark,
    private readonly scene: THREE.Scene,
    private readonly center: THREE.Vector3,
  ) {
    this.lines = new PathLines(path, center);
    this.lines.set({ dotted: 1 });
    this.lines.mesh.renderOrder = 0.5; // Under the other path.
    scene.add(this.lines.mesh);
  }

  paint(parts: ShownParts): void {
    this.parts = parts;
    // Sections are those of the path beside it.
    this.hidden = hiddenSteps(this.path, { ...parts.filter, sections: new Set(), lines: [] });
    this.lines.paint(stepColors(this.path, parts.mode, parts.theme, this.markOf), (step) => this.shows(step));
    this.lines.keepHeights(parts.filter.minZ, parts.filter.maxZ);
    const [steps, isMarked] = [this.litSteps, this.isMarked];
    this.light(null);
    this.light(steps, isMarked);
  }

  /** Where its tool is then. */
  setTime(time: number, sceneSize: number): void {
    const { path } = this;
    const place = path.at(time);
    const tool = path.facts.tools[place.step < 0 ? 0 : path.stepTool[place.step]];
    if (this.parts) this.tool.dress(tool, this.parts.theme, sceneSize, 0.45);
    const turns = path.facts.turnsTool;
    this.tool.place(new THREE.Vector3(...place.tip), turns ? place.b : 0, turns ? place.c : 0);
    this.lines.set({ reached: place.point - 1, reachedPart: place.part });
  }

  /** Lights steps up; marked, in the colors of what has become of them. */
  light(steps: Steps | null, isMarked = false): void {
    if (steps?.start === this.litSteps?.start && steps?.end === this.litSteps?.end && isMarked === this.isMarked) return;
    this.litSteps = steps;
    this.isMarked = isMarked;
    if (this.lit) {
      this.scene.remove(this.lit.mesh);
      this.lit.dispose();
      this.lit = null;
    }
    if (!steps || steps.start < 0 || !this.parts) return;
    const { path, parts } = this;
    const [first, last] = [path.stepStart[steps.start], path.stepStart[steps.end]];
    if (first === last) return;
    this.lit = new PathLines(path, this.center, first, last);
    this.lit.set({ dotted: 1 });
    this.lit.alwaysInFront = true;
    this.lit.keepHeights(parts.filter.minZ, parts.filter.maxZ);
    const { highlight } = palettes[parts.theme];
    this.lit.paint(isMarked ? stepColors(path, 'change', parts.theme, this.markOf) : () => highlight, (step) => this.shows(step));
    this.scene.add(this.lit.mesh);
  }

  /** What of it is lit up, to be drawn as the other lines are. */
  get litLines(): PathLines | null {
    return this.lit;
  }

  dispose(): void {
    this.light(null);
    this.scene.remove(this.lines.mesh);
    this.lines.dispose();
  }

  shows(step: number): boolean {
    const kind = this.path.stepKind[step];
    return kind !== Kind.Wait && (kind !== Kind.Rapid || (this.parts?.rapids ?? true)) && !this.hidden?.[step];
  }
}

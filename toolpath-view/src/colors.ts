/** Colors of the path. All sets can be distinguished with every kind of color vision, by lightness where hues fail. */
import type { Mark } from './comparison';
import type { Role, Severity } from './scene';
import { Kind, type Toolpath } from './toolpath';

export type Theme = 'light' | 'dark' | 'contrastLight' | 'contrastDark';
export type Mode = 'change' | 'tool' | 'feed' | 'kind' | 'time';
export const modes: Mode[] = ['tool', 'feed', 'kind', 'time'];

/** Red, green, blue, 0 to 255. */
export type Color = [number, number, number];

function color(hex: string): Color {
  const value = parseInt(hex.slice(1), 16);
  return [value >> 16, (value >> 8) & 0xff, value & 0xff];
}
export const css = ([r, g, b]: Color) => `rgb(${r} ${g} ${b})`;
export const number = ([r, g, b]: Color) => (r << 16) | (g << 8) | b;

interface Palette {
  background: Color;
  grid: Color;
  highlight: Color;
  /** For the stock, and in the legend where the colors mean something else. */
  neutral: Color;
  /** Of tools; the first is none. */
  tools: Color[];
  /** The first is also the color of rapids by feed. */
  kinds: [rapid: Color, feed: Color, arc: Color];
  feed: Color[];
  time: Color[];
  axes: [x: Color, y: Color, z: Color];
  travel: Color;
  cutter: Color;
  holder: Color;
  /** Of what surrounds the program. */
  bodies: Record<Role, Color>;
  bodyEdge: Color;
  measure: Color;
  /** Of a surface that is to become the finished part: material is left, it is right, too much is gone. */
  deviation: { left: Color; within: Color; gouged: Color };
  /** Below the blank's top, from nothing to the greatest depth. */
  depth: Color[];
  /** Of marks where bodies touch. */
  contacts: Record<Severity, Color>;
  /** Of what another program does otherwise. The old path is dotted besides. */
  marks: Record<Exclude<Mark, 'same'>, Color>;
}

const colors = (...hex: string[]) => hex.map(color);

export const palettes: Record<Theme, Palette> = {
  light: {
    background: color('#f7f8fa'),
    grid: color('#d9dde4'),
    highlight: color('#d6006c'),
    neutral: color('#8b929e'),
    tools: colors('#6b7280', '#0072b2', '#d55e00', '#009e73', '#b84d8f', '#a67c00', '#3d9fd6', '#1c1f26'),
    kinds: [color('#8b929e'), color('#0072b2'), color('#d55e00')],
    feed: colors('#0b3c7d', '#3f7fb5', '#8a8f98', '#d08a36', '#a84300'),
    time: colors('#440154', '#3b528b', '#21918c', '#49a84f', '#a39400'),
    axes: [color('#c2410c'), color('#15803d'), color('#1d4ed8')],
    travel: color('#9aa2af'),
    cutter: color('#5b6472'),
    holder: color('#a9b1bd'),
    bodies: {
      fixture: color('#6f93b5'),
      spoilboard: color('#d8c7a6'),
      target: color('#8fb99a'),
      stock: color('#b9b2c9'),
      machine: color('#9aa3b0'),
    },
    measure: color('#0057b8'),
    deviation: { left: color('#2f74c9'), within: color('#a9dcb8'), gouged: color('#b3261e') },
    depth: colors('#f4e3a1', '#e3a857', '#b5633f', '#7a2f4f', '#3b1550'),
    bodyEdge: color('#4a5260'),
    contacts: { error: color('#c62828'), warning: color('#b26a00'), info: color('#2f6fa8') },
    marks: { moved: color('#1a8cff'), added: color('#006b40'), removed: color('#ed6710'), changed: color('#6b2f94') },
  },
  dark: {
    background: color('#14171c'),
    grid: color('#2a2f38'),
    highlight: color('#ff5fa8'),
    neutral: color('#7f8896'),
    tools: colors('#8b93a1', '#56b4e9', '#e69f00', '#2fc99e', '#e58ac0', '#f0e442', '#7f9cff', '#ffffff'),
    kinds: [color('#7f8896'), color('#56b4e9'), color('#e69f00')],
    feed: colors('#3f8cff', '#8fc1ff', '#c9ccd2', '#ffc37d', '#ff8a2a'),
    time: colors('#7a66e8', '#4590d8', '#2fb7a8', '#86d05c', '#fde725'),
    axes: [color('#ff8a65'), color('#5fd08a'), color('#7aa2ff')],
    travel: color('#5c6674'),
    cutter: color('#c3cad5'),
    holder: color('#6d7684'),
    bodies: {
      fixture: color('#6d8fb0'),
      spoilboard: color('#7d6d50'),
      target: color('#5f9a76'),
      stock: color('#77709a'),
      machine: color('#6f7988'),
    },
    measure: color('#8fd3ff'),
    deviation: { left: color('#3f8fe8'), within: color('#bfe8c6'), gouged: color('#d8432f') },
    depth: colors('#f7e9b0', '#e8b469', '#c9704d', '#96466a', '#5a3a86'),
    bodyEdge: color('#c3cad5'),
    contacts: { error: color('#ff6b60'), warning: color('#f2b13d'), info: color('#6cb6ff') },
    marks: { moved: color('#69a3fc'), added: color('#0bfe7e'), removed: color('#ef6906'), changed: color('#980efc') },
  },
  contrastLight: {
    background: color('#ffffff'),
    grid: color('#c4c4c4'),
    highlight: color('#c00060'),
    neutral: color('#4a4a4a'),
    tools: colors('#3a3a3a', '#00558a', '#a63c00', '#00664a', '#8a1f66', '#6b5000', '#0f6fa8', '#000000'),
    kinds: [color('#4a4a4a'), color('#00558a'), color('#a63c00')],
    feed: colors('#06285a', '#1f5f96', '#55585e', '#8f5408', '#7a2f00'),
    time: colors('#2d0038', '#2c3f73', '#11605c', '#246b2a', '#665c00'),
    axes: [color('#a33000'), color('#00601f'), color('#0f3cc9')],
    travel: color('#292929'),
    cutter: color('#333333'),
    holder: color('#777777'),
    bodies: {
      fixture: color('#3f6f9f'),
      spoilboard: color('#c9b48a'),
      target: color('#4f9468'),
      stock: color('#7d74a0'),
      machine: color('#7a7a7a'),
    },
    measure: color('#003f8a'),
    deviation: { left: color('#0b57b0'), within: color('#9fe0b0'), gouged: color('#990f0a') },
    depth: colors('#f2dc8a', '#d9933a', '#9c4a2a', '#611d3f', '#270738'),
    bodyEdge: color('#000000'),
    contacts: { error: color('#b00020'), warning: color('#8a4b00'), info: color('#004f9e') },
    marks: { moved: color('#0755fc'), added: color('#0d8938'), removed: color('#4a2403'), changed: color('#9d4dbf') },
  },
  contrastDark: {
    background: color('#000000'),
    grid: color('#3d3d3d'),
    highlight: color('#ff7ab8'),
    neutral: color('#bdbdbd'),
    tools: colors('#c8c8c8', '#7cc8ff', '#ffb733', '#45e6b5', '#ffa8dc', '#fff36b', '#a8bcff', '#ffffff'),
    kinds: [color('#c8c8c8'), color('#7cc8ff'), color('#ffb733')],
    feed: colors('#6fa8ff', '#a8d0ff', '#e6e6e6', '#ffd39a', '#ff9d45'),
    time: colors('#a596ff', '#6fb2f2', '#4bd6c6', '#a3ea7a', '#fff24d'),
    axes: [color('#ff9d7a'), color('#7df0a6'), color('#9db9ff')],
    travel: color('#d4d4d4'),
    cutter: color('#ffffff'),
    holder: color('#a0a0a0'),
    bodies: {
      fixture: color('#7fb4e6'),
      spoilboard: color('#a08a5c'),
      target: color('#6cc48f'),
      stock: color('#a398d6'),
      machine: color('#9a9a9a'),
    },
    measure: color('#a6e0ff'),
    deviation: { left: color('#4da3ff'), within: color('#d2f7d8'), gouged: color('#ff3b2e') },
    depth: colors('#fff3c2', '#ffc873', '#e8875f', '#b95c86', '#7d58b8'),
    bodyEdge: color('#ffffff'),
    contacts: { error: color('#ff8078'), warning: color('#ffc14d'), info: color('#8cc8ff') },
    marks: { moved: color('#357aaf'), added: color('#43fe89'), removed: color('#cd4b00'), changed: color('#a932fc') },
  },
};

export function mixed(one: Color, other: Color): Color {
  return one.map((value, i) => Math.round((value + other[i]) / 2)) as Color;
}

export function toolColor(theme: Theme, tool: number): Color {
  const { tools } = palettes[theme];
  return tool === 0 ? tools[0] : tools[1 + ((tool - 1) % (tools.length - 1))];
}

export function gradient(stops: Color[], part: number): Color {
  const at = Math.min(Math.max(part, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(at), stops.length - 2);
  const mix = (channel: number) => Math.round(stops[i][channel] + (at - i) * (stops[i + 1][channel] - stops[i][channel]));
  return [mix(0), mix(1), mix(2)];
}

export function feedRange(path: Toolpath): { min: number; max: number } | null {
  let [min, max] = [Infinity, -Infinity];
  for (let step = 0; step < path.stepCount; ++step) {
    const feed = path.stepFeed[step];
    if (!(feed > 0)) continue;
    min = Math.min(min, feed);
    max = Math.max(max, feed);
  }
  return min <= max ? { min, max } : null;
}

export function markColor(theme: Theme, mark: Mark): Color {
  return mark === 'same' ? palettes[theme].neutral : palettes[theme].marks[mark];
}

/** The color of each step; `markOf` says what has become of it. */
export function stepColors(path: Toolpath, mode: Mode, theme: Theme, markOf: (step: number) => Mark = () => 'same'): (step: number) => Color {
  const palette = palettes[theme];
  switch (mode) {
    case 'change':
      return (step) => markColor(theme, markOf(step));
    case 'tool':
      return (step) => toolColor(theme, path.stepTool[step]);
    case 'kind':
      return (step) => palette.kinds[Math.min(path.stepKind[step], Kind.Arc)];
    case 'time': {
      const whole = path.seconds || 1;
      return (step) => gradient(palette.time, path.endOf(step) / whole);
    }
    case 'feed': {
      const range = feedRange(path);
      const [rapid] = palette.kinds;
      if (!range) return () => rapid;
      const width = range.max - range.min || 1;
      return (step) =>
        path.stepFeed[step] > 0 ? gradient(palette.feed, (path.stepFeed[step] - range.min) / width) : rapid;
    }
  }
}

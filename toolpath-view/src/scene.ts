/** What surrounds the program: bodies, shapes of tools and what they hit, as isorun and isols describe them in the facts of a
 * recording. All of it is optional there. mm, degrees, seconds. */
import type { Vector } from './toolpath';

/** What a body is for. */
export const roles = ['fixture', 'spoilboard', 'target', 'stock', 'machine'] as const;
export type Role = (typeof roles)[number];

/** The part of the machine that carries a body (interpreter/kinematics/links.h). */
export const links = ['machine', 'X', 'Y', 'Z', 'C', 'B'] as const;
export type Link = (typeof links)[number];

/** The geometry of the machine (interpreter/kinematics/machine.h). Vectors in the machine frame, with B and C at 0. */
export interface KinematicsFact {
  type: 'threeAxis' | 'head' | 'table';
  /** Head: from the B axis down to the spindle nose. */
  pivot: number;
  /** Head: from the B axis to the spindle axis. */
  spindleFromB: Vector;
  /** Head: from the C axis to the B axis. */
  bFromC: Vector;
  /** Table: a point of the B axis. */
  bPoint: Vector;
  /** Table: a point of the C axis. */
  cPoint: Vector;
}

/** The profile of a body of revolution: heights along its axis, each with a radius. */
export type Outline = [z: number, radius: number][];

/** Heights above the tip. A part without an outline is of unknown shape, or there is none. */
export interface ToolShape {
  /** From the tip to the spindle nose. */
  length: number;
  cutter: Outline | null;
  shank: Outline | null;
  holder: Outline | null;
}

export interface CylinderShape {
  /** The center of the lower disc. */
  at: Vector;
  axis: Vector;
  height: number;
  radius: number;
}

/** A solid body, in the machine frame with all joints at 0. */
export interface SceneBody {
  name: string;
  role: Role;
  /** The workpiece is on the machine, or on the round table (C) of a machine with a table. */
  on: Link | 'workpiece';
  /** By which its shape is moved. */
  at: Vector;
  /** The lower and the upper corner. */
  box?: [Vector, Vector];
  cylinder?: CylinderShape;
  /** Base64 of 32-bit floats, little-endian, nine for each triangle. */
  mesh?: { positions: string };
}

export interface Scene {
  /** The file that describes the setup. */
  name: string;
  kinematics: KinematicsFact;
  /** Heights above the spindle nose, away from the tool. */
  nose: Outline | null;
  /** By the code of the tool, such as T101001. */
  tools: Record<string, ToolShape>;
  bodies: SceneBody[];
}

export const severities = ['error', 'warning', 'info'] as const;
export type Severity = (typeof severities)[number];

/** A moving body that hits another one, or passes it too near. */
export interface Contact {
  /** Such as E152. */
  code: string;
  severity: Severity;
  /** Of the first touch; from 1. */
  line: number;
  /** Of the last touch; from 1. */
  endLine: number;
  /** Since the start of the run. */
  time: number;
  endTime: number;
  tool: string;
  /** The name of the moving body. */
  who: string;
  /** The name of the body that it hits. */
  whom: string;
  /** Of the body that is hit: machine frame, with all joints at 0. */
  point: Vector;
  /** Negative is a depth. */
  distance: number;
  message: Record<'en' | 'it', string>;
}

/** The severity of a contact; one that is unknown counts as an error. */
export const severityOf = ({ severity }: Contact): Severity => (severities.includes(severity) ? severity : 'error');

/** The body that a contact is with. The spoilboard and the part need no name; a contact then calls them what they are. */
export function bodyOf({ code, whom }: Contact, { bodies }: Scene): SceneBody | undefined {
  const unnamed: Role = code === 'E155' ? 'target' : 'spoilboard';
  return bodies.find(({ name }) => name !== '' && name === whom) ?? bodies.find(({ name, role }) => name === '' && role === unnamed);
}

/** The code of a tool, with which its shown name starts; null is no tool. */
export const codeOf = (shownName: string | null) => shownName?.split(' ', 1)[0] ?? null;

/** Corners of triangles, three numbers each; an incomplete triangle at the end is left out. */
export function trianglesOf(base64: string): Float32Array {
  const text = atob(base64);
  const count = Math.floor(text.length / 36) * 9;
  const bytes = new DataView(new ArrayBuffer(4 * count));
  for (let i = 0; i < bytes.byteLength; ++i) bytes.setUint8(i, text.charCodeAt(i));
  return Float32Array.from({ length: count }, (_, i) => bytes.getFloat32(4 * i, true));
}

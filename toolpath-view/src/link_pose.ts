/** Where the parts of a machine are, as interpreter/kinematics/links.cpp and kinematics.cpp have it. mm, degrees, machine frame. */
import { Matrix4, Vector3, MathUtils } from 'three';
import type { KinematicsFact, Link } from './scene';
import type { Vector } from './toolpath';

/** Positions of the axes. X, Y, Z are that of the spindle nose at B = C = 0. */
export interface Joints {
  x: number;
  y: number;
  z: number;
  b: number;
  c: number;
}

const { degToRad } = MathUtils;
const shift = (by: Vector3) => new Matrix4().makeTranslation(by);

/** Rz(C) Ry(B). */
const turnAxes = (b: number, c: number) => new Matrix4().makeRotationZ(degToRad(c)).multiply(new Matrix4().makeRotationY(degToRad(b)));
const turn = (b: number, c: number, about: Vector3) => shift(about).multiply(turnAxes(b, c)).multiply(shift(about.clone().negate()));

/** From the spindle nose of a head to its B axis, at B = C = 0. */
const arm = ({ pivot, spindleFromB }: KinematicsFact) => new Vector3(0, 0, pivot).sub(new Vector3(...spindleFromB));

/** Positions of the axes that hold the tip of a tool at a place of the path; the length is that from the tip to the spindle nose. */
export function jointsOf(kinematics: KinematicsFact, tip: Vector, b: number, c: number, length: number): Joints {
  const tool = new Vector3(0, 0, length);
  const at = new Vector3(...tip);
  switch (kinematics.type) {
    case 'threeAxis':
      at.add(tool);
      break;
    case 'head': {
      const bFromC = new Vector3(...kinematics.bFromC);
      const reach = arm(kinematics).add(tool).applyMatrix4(turnAxes(b, 0)).sub(bFromC).applyMatrix4(turnAxes(0, c));
      at.add(reach).add(bFromC).sub(arm(kinematics));
      break;
    }
    case 'table': {
      const [onB, onC] = [new Vector3(...kinematics.bPoint), new Vector3(...kinematics.cPoint)];
      at.sub(onC).applyMatrix4(turnAxes(0, -c)).add(onC).sub(onB).applyMatrix4(turnAxes(-b, 0)).add(onB).add(tool);
      break;
    }
  }
  return { x: at.x, y: at.y, z: at.z, b, c };
}

/** What takes a point of a link from its place with all joints at 0 to its place now. */
export function linkPose(kinematics: KinematicsFact, link: Link, { x, y, z, b, c }: Joints): Matrix4 {
  const carried = shift(new Vector3(x, y, z));
  switch (link) {
    case 'machine':
      return new Matrix4();
    case 'X':
      return shift(new Vector3(x, 0, 0));
    case 'Y':
      return shift(new Vector3(x, y, 0));
    case 'Z':
      return carried;
  }
  switch (kinematics.type) {
    case 'threeAxis':
      return carried;
    case 'head': {
      const onB = arm(kinematics);
      carried.multiply(turn(0, c, onB.clone().sub(new Vector3(...kinematics.bFromC))));
      return link === 'C' ? carried : carried.multiply(turn(b, 0, onB));
    }
    case 'table': {
      const cradle = turn(-b, 0, new Vector3(...kinematics.bPoint));
      return link === 'B' ? cradle : cradle.multiply(turn(0, -c, new Vector3(...kinematics.cPoint)));
    }
  }
}

/** The link that carries the spindle. */
export const spindleLink = ({ type }: KinematicsFact): Link => (type === 'head' ? 'B' : 'Z');
/** The link that carries the workpiece. */
export const workpieceLink = ({ type }: KinematicsFact): Link => (type === 'table' ? 'C' : 'machine');

/** Where a link is as seen from the workpiece, in whose frame the path is drawn: the path rests, and on a machine with a table the
 * rest of the machine turns around it. */
export function poseBesideWorkpiece(kinematics: KinematicsFact, link: Link, joints: Joints): Matrix4 {
  return linkPose(kinematics, workpieceLink(kinematics), joints).invert().multiply(linkPose(kinematics, link, joints));
}

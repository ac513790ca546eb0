/** The faces of material where a plane cuts it. */
import { isOneSurface, steepest } from './stock_surface';
import { MeshWriter, trianglesIn, type Surface } from './stock_mesh';
import { noMaterial, type Dexels, type StockFacts } from './stock';
import type { Section } from './stock_ray';

/** Beyond this, cells of a level plane are taken together. */
const maxTriangles = 40_000;

export function sectionFaces(dexels: Dexels, facts: StockFacts, section: Section): Surface {
  if (section.axis !== 2) return upright(dexels, facts, section as Section & { axis: 0 | 1 });
  for (let step = 1; ; step *= 2) {
    const faces = level(dexels, facts, section, step);
    if (trianglesIn(faces) <= maxTriangles || step >= 64) return faces;
  }
}

/** Along a row or a column of dexels. */
function upright(dexels: Dexels, { first, spacing }: StockFacts, { axis, at, keeps }: Section & { axis: 0 | 1 }): Surface {
  const writer = new MeshWriter();
  const size = [dexels.columns, dexels.rows];
  const along = axis === 0 ? 1 : 0;
  const fixed = Math.round((at - first[axis]) / spacing[axis]);
  if (fixed < 0 || fixed >= size[axis]) return writer.take();
  const dexelAt = (i: number) => (axis === 0 ? i * dexels.columns + fixed : fixed * dexels.columns + i);
  const topAt = (i: number) => (i < 0 || i >= size[along] ? noMaterial : dexels.tops[dexelAt(i)]);
  const normal = [0, 0];
  normal[axis] = -keeps;
  // From left to right as seen from where the normal points.
  const isForward = (axis === 0) === keeps < 0;
  const put = (place: number, z: number) =>
    axis === 0 ? writer.corner(at, place, z / 1000, normal[0], normal[1], 0, 0) : writer.corner(place, at, z / 1000, normal[0], normal[1], 0, 0);
  const face = (from: number, to: number, topFrom: number, topTo: number, bottom: number) => {
    const [a, b, c, d] = [put(from, bottom), put(to, bottom), put(to, topTo), put(from, topFrom)];
    for (const [p, q, r] of [[a, b, c], [a, c, d]]) if (isForward) writer.triangle(p, q, r);
      else writer.triangle(p, r, q);
  };
  /** The height between a dexel and the next one, as the surface has it; that of the dexel where it ends. */
  const between = (i: number, next: number) => {
    const [here, there] = [topAt(i), topAt(next)];
    const goesOn = isOneSurface(topAt(2 * i - next), here, there, topAt(2 * next - i), 1000 * steepest * spacing[along]);
    return goesOn ? (here + there) / 2 : here;
  };
  for (let i = 0; i < size[along]; ++i) {
    const dexel = dexelAt(i);
    if (!dexels.hasMaterial(dexel)) continue;
    const [from, to] = [first[along] + (i - 0.5) * spacing[along], first[along] + (i + 0.5) * spacing[along]];
    const bottom = dexels.bottoms[dexel];
    face(from, to, Math.max(between(i, i - 1), bottom), Math.max(between(i, i + 1), bottom), bottom);
    const more = dexels.more.get(dexel);
    if (more) for (let k = 0; k < more.length; k += 2) face(from, to, more[k], more[k], more[k + 1]);
  }
  return writer.take();
}

/** Of one height, in runs along the rows. */
function level(dexels: Dexels, { first, spacing }: StockFacts, { at, keeps }: Section, step: number): Surface {
  const writer = new MeshWriter();
  const { columns, rows } = dexels;
  const height = 1000 * at;
  const put = (column: number, row: number) =>
    writer.corner(first[0] + (column - 0.5) * spacing[0], first[1] + (row - 0.5) * spacing[1], at, 0, 0, -keeps, 0);
  for (let row = 0; row < rows; row += step)
    for (let column = 0; column < columns; column += step) {
      const start = column;
      while (column < columns && dexels.isSolid(row * columns + column, height)) column += step;
      if (column === start) continue;
      const [right, upper] = [Math.min(column, columns), Math.min(row + step, rows)];
      const [a, b, c, d] = [put(start, row), put(right, row), put(right, upper), put(start, upper)];
      for (const [p, q, r] of [[a, b, c], [a, c, d]]) if (keeps < 0) writer.triangle(p, q, r);
        else writer.triangle(p, r, q);
    }
  return writer.take();
}

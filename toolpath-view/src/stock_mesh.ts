/** Triangles as they are gathered, and as a graphics card takes them. */

export interface Surface {
  /** X, Y, Z of each corner; mm. */
  positions: Float32Array;
  /** Of each corner X, Y, Z and nothing; 32767 is 1. */
  normals: Int16Array;
  /** Of each corner red, green, blue and nothing. */
  colors: Uint8Array;
  indices: Uint32Array;
}

export const trianglesIn = ({ indices }: Surface) => indices.length / 3;
export const bytesIn = ({ positions, normals, colors, indices }: Surface) =>
  positions.byteLength + normals.byteLength + colors.byteLength + indices.byteLength;

export class MeshWriter {
  private positions = new Float32Array(3 * 1024);
  private normals = new Int16Array(4 * 1024);
  private colors = new Uint8Array(4 * 1024);
  private indices = new Uint32Array(6 * 1024);
  private corners = 0;
  private used = 0;

  /** Color is 0xrrggbb. Returns the number of the corner. */
  corner(x: number, y: number, z: number, nx: number, ny: number, nz: number, color: number): number {
    if (this.corners * 4 === this.colors.length) this.grow();
    const at = this.corners;
    this.positions[3 * at] = x;
    this.positions[3 * at + 1] = y;
    this.positions[3 * at + 2] = z;
    this.normals[4 * at] = Math.round(32767 * nx);
    this.normals[4 * at + 1] = Math.round(32767 * ny);
    this.normals[4 * at + 2] = Math.round(32767 * nz);
    this.colors[4 * at] = color >> 16;
    this.colors[4 * at + 1] = color >> 8;
    this.colors[4 * at + 2] = color;
    this.colors[4 * at + 3] = 255;
    return this.corners++;
  }

  /** Counterclockwise as seen from outside. */
  triangle(a: number, b: number, c: number): void {
    if (this.used + 3 > this.indices.length) this.indices = grown(this.indices, new Uint32Array(2 * this.indices.length));
    this.indices[this.used++] = a;
    this.indices[this.used++] = b;
    this.indices[this.used++] = c;
  }

  /** What has been gathered since the last time. */
  take(): Surface {
    const { corners, used } = this;
    this.corners = this.used = 0;
    return {
      positions: this.positions.slice(0, 3 * corners),
      normals: this.normals.slice(0, 4 * corners),
      colors: this.colors.slice(0, 4 * corners),
      indices: this.indices.slice(0, used),
    };
  }

  private grow(): void {
    const size = 2 * this.corners;
    this.positions = grown(this.positions, new Float32Array(3 * size));
    this.normals = grown(this.normals, new Int16Array(4 * size));
    this.colors = grown(this.colors, new Uint8Array(4 * size));
  }
}

function grown<Values extends { set(values: Values): void }>(old: Values, room: Values): Values {
  room.set(old);
  return room;
}

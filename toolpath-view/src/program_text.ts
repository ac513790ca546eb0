/** A program's lines, decoded when they are looked at. They end at CR, LF or CR LF. */
export class ProgramText {
  private readonly starts: Uint32Array;
  readonly lineCount: number;

  constructor(private readonly bytes: Uint8Array) {
    this.starts = Uint32Array.from([...lineStarts(bytes), bytes.length]);
    this.lineCount = this.starts.length - 1;
  }

  line(index: number): string {
    const bytes = this.bytes.subarray(this.starts[index], this.starts[index + 1]);
    return new TextDecoder().decode(bytes).replace(/[\r\n]+$/, '');
  }
}

const [lf, cr] = [10, 13];

function* lineStarts(bytes: Uint8Array): Generator<number> {
  for (let start = 0; start < bytes.length; ) {
    yield start;
    while (start < bytes.length && bytes[start] !== lf && bytes[start] !== cr) ++start;
    start += bytes[start] === cr && bytes[start + 1] === lf ? 2 : 1;
  }
}

/** A program's lines, decoded when they are looked at. They end at CR, LF or CR LF. */
export class ProgramText {
  private readonly begins: Uint32Array;
  readonly lineCount: number;

  constructor(private readonly bytes: Uint8Array) {
    this.begins = Uint32Array.from([...lineBegins(bytes), bytes.length]);
    this.lineCount = this.begins.length - 1;
  }

  line(index: number): string {
    const bytes = this.bytes.subarray(this.begins[index], this.begins[index + 1]);
    return new TextDecoder().decode(bytes).replace(/[\r\n]+$/, '');
  }
}

const [lf, cr] = [10, 13];

function* lineBegins(bytes: Uint8Array): Generator<number> {
  for (let begin = 0; begin < bytes.length; ) {
    yield begin;
    while (begin < bytes.length && bytes[begin] !== lf && bytes[begin] !== cr) ++begin;
    begin += bytes[begin] === cr && bytes[begin + 1] === lf ? 2 : 1;
  }
}

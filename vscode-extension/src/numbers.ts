/** Numbers that people write into a field. */

/** Numbers as people write them, with commas or blanks between them; null if these are not `least` to `most` numbers. */
export function numbersOf(text: string, least: number, most = least): number[] | null {
  const words = text.trim().split(/\s*,\s*|\s+/);
  const numbers = words.map((word) => (/^[+-]?(\d+\.?\d*|\.\d+)$/.test(word) ? Number(word) : NaN));
  return numbers.length >= least && numbers.length <= most && numbers.every(Number.isFinite) ? numbers : null;
}

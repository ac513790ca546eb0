/** Whether a version is older than a wanted one. Unreadable ones are: what they can do is unknown. */
export function isOlder(version: string | undefined, wanted: string): boolean {
  const numbers = (text: string) => /^(\d+)\.(\d+)\.(\d+)/.exec(text)?.slice(1).map(Number);
  const [have, want] = [numbers(version ?? ''), numbers(wanted)];
  if (!have || !want) return true;
  const differing = have.findIndex((number, i) => number !== want[i]);
  return differing >= 0 && have[differing] < want[differing];
}

/** 1:02:03.4, 2:03.4, 0:03.4 */
export function clock(seconds: number): string {
  const tenths = Math.round(seconds * 10);
  const [hours, minutes] = [Math.floor(tenths / 36000), Math.floor(tenths / 600) % 60];
  const rest = ((tenths % 600) / 10).toFixed(1).padStart(4, '0');
  return hours > 0 ? `${hours}:${String(minutes).padStart(2, '0')}:${rest}` : `${minutes}:${rest}`;
}

/** Five digits: with G93 feeds are worked out, and come out as 2999.997. */
export const feed = (value: number) => String(Number(value.toPrecision(5)));

/** mm as m from ten meters on. */
export const lengthText = (mm: number) => (mm < 10_000 ? `${mm.toFixed(0)} mm` : `${(mm / 1000).toFixed(1)} m`);

export const coordinate = (value: number) => (Math.abs(value) < 0.0005 ? 0 : value).toFixed(3);

/** Drawn, since not every system has letters for them. */
import { svg } from './elements';

const shapes = {
  play: 'M5 3l9 5-9 5z',
  pause: 'M4 3h3v10H4zM9 3h3v10H9z',
  previous: 'M3 3h2v10H3zM13 3v10L6 8z',
  next: 'M11 3h2v10h-2zM3 3v10l7-5z',
  up: 'M8 4l6 7H2z',
  down: 'M8 12L2 5h12z',
  theme: 'M8 1.5a6.5 6.5 0 1 0 0 13a6.5 6.5 0 1 0 0-13zM8 3v10a5 5 0 1 1 0-10z',
  measure: 'M0 4h16v8H0zM1.2 5.2v5.6h13.6V5.2h-1.3v2.6h-1.2V5.2h-1.5v1.6H9.6V5.2H8.6v2.6H7.4V5.2H6.4v1.6H5.2V5.2H3.7v2.6H2.5V5.2z',
  display: 'M1 3h6.3a2.2 2.2 0 0 1 4.4 0H15v1.4h-3.3a2.2 2.2 0 0 1-4.4 0H1zM1 11h2.3a2.2 2.2 0 0 1 4.4 0H15v1.4H7.7a2.2 2.2 0 0 1-4.4 0H1z',
  otherSide: 'M7.3 1h1.4v14H7.3zM6 8L2 4.5v7zM10 8l4-3.5v7z',
  hide: 'M1.5 2.5h13L9.6 8.6v5.2l-3.2-1.6V8.6z',
};

export function icon(name: keyof typeof shapes): SVGElement {
  const shape = svg('path', { d: shapes[name], fill: 'currentColor', 'fill-rule': 'evenodd' });
  return svg('svg', { width: '16', height: '16', viewBox: '0 0 16 16', 'aria-hidden': 'true' }, shape);
}

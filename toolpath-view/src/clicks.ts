/** Clicks on the picture with a mouse, a pen or a finger. */

export interface Click {
  /** Pixels of the page. */
  x: number;
  y: number;
  /** How much wider than a mouse's the reach of the pointer is: a finger covers what it points at. */
  reach: number;
}

const fingerReach = 2.2;
/** Pixels that a pointer may move between down and up. */
const still = 4;

/** Clicks, not the ends of drags, nor of gestures with several fingers. */
export function listenForClicks(canvas: HTMLCanvasElement, onClick: (click: Click) => void): void {
  let start: { x: number; y: number } | null = null;
  canvas.addEventListener('pointerdown', (event) => (start = event.isPrimary ? { x: event.clientX, y: event.clientY } : null));
  canvas.addEventListener('pointerup', (event) => {
    const reach = event.pointerType === 'touch' ? fingerReach : 1;
    if (!start || event.button !== 0 || Math.hypot(event.clientX - start.x, event.clientY - start.y) > still * reach) return;
    const box = canvas.getBoundingClientRect();
    onClick({ x: event.clientX - box.left, y: event.clientY - box.top, reach });
  });
}

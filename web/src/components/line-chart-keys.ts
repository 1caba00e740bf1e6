/** What the keyboard does in a chart. */
import { moved, type Range, scaled, showing } from '@/lib/zoom';

interface Place {
  readonly x: readonly number[];
  /** Where the cursor is among the points, null if nowhere. */
  readonly at: number | null;
  readonly range: Range;
  readonly whole: Range;
}

/** What a key asks for: a new place of the cursor, or another window. */
export interface KeyWish {
  readonly at?: number;
  /** The window to show, null for the whole. */
  readonly range?: Range | null;
}

const ZOOM = 0.5;
const PAN = 0.25;

/** Read a key; undefined if it means nothing here. */
export function readChartKey(key: string, isShifted: boolean, { x, at, range, whole }: Place): KeyWish | undefined {
  const last = x.length - 1;
  if (last < 0) return undefined;
  const now = at ?? last;
  const centre = at === null ? (range[0] + range[1]) / 2 : (x[at] ?? 0);
  const step = (next: number): KeyWish => {
    const to = Math.min(last, Math.max(0, next));
    return { at: to, range: showing(range, whole, x[to] ?? 0) };
  };
  switch (key) {
    case 'ArrowLeft':
      return isShifted ? { range: moved(range, whole, -PAN) } : step(at === null ? last : now - 1);
    case 'ArrowRight':
      return isShifted ? { range: moved(range, whole, PAN) } : step(now + 1);
    case 'Home':
      return step(0);
    case 'End':
      return step(last);
    case '+':
    case '=':
      return { range: scaled(range, whole, centre, ZOOM) };
    case '-':
    case '_':
      return { range: scaled(range, whole, centre, 1 / ZOOM) };
    case '0':
    case 'Escape':
      return { range: null };
    default:
      return undefined;
  }
}

/** Colours and dash patterns that stay apart for every kind of colour vision, on light and on dark. */
import type { RunState } from '@/client/schema.gen';

export type Scheme = 'light' | 'dark';

/** One way to draw a line: colour for most, dash for all. */
export interface LineStyle {
  readonly color: string;
  /** Lengths of line and gap [px]; empty for a solid line. */
  readonly dash: readonly number[];
}

// Okabe and Ito's colours, darkened or lightened until each has a contrast of at least 3 against the page.
const COLORS: Record<Scheme, readonly string[]> = {
  light: ['#0067a8', '#c25700', '#00805c', '#a8508a', '#8a6d00', '#2b8fc9', '#555b66'],
  dark: ['#62b0ea', '#f29a4a', '#2fc79a', '#e39cc8', '#e3cf4b', '#9cd7fa', '#b4bac4'],
};

const DASHES: readonly (readonly number[])[] = [[], [7, 3], [2, 2], [9, 3, 2, 3], [12, 4], [4, 2, 1, 2], [1, 3]];

/** The style of the n-th line of a chart. */
export function lineStyle(index: number, scheme: Scheme): LineStyle {
  const colors = COLORS[scheme];
  return { color: colors[index % colors.length] ?? '#888888', dash: DASHES[index % DASHES.length] ?? [] };
}

/** The style of a group of runs: the server gives every method a place of its own, the same in all charts and figures. */
export function groupStyle({ color, dash }: { color: number; dash: number }, scheme: Scheme): LineStyle {
  return { color: lineStyle(color, scheme).color, dash: lineStyle(dash, scheme).dash };
}

/** Stripes and dots for what is filled, one for each dash pattern of lines, as in exported figures; `ink` stands for the colour. */
const FILLS: readonly string[] = [
  'linear-gradient(ink, ink)',
  'repeating-linear-gradient(-45deg, ink 0 3px, transparent 3px 6px)',
  'radial-gradient(ink 1.2px, transparent 1.6px) 0 0 / 5px 5px',
  'repeating-linear-gradient(45deg, ink 0 3px, transparent 3px 6px)',
  'repeating-linear-gradient(45deg, ink 0 1px, transparent 1px 5px), repeating-linear-gradient(-45deg, ink 0 1px, transparent 1px 5px)',
  'repeating-linear-gradient(0deg, ink 0 2px, transparent 2px 5px)',
  'repeating-linear-gradient(90deg, ink 0 2px, transparent 2px 5px)',
];

/** The background of a bar that stands for a group: its colour for most, a pattern for all. */
export function groupFill({ color, dash }: { color: number; dash: number }, scheme: Scheme): string {
  const ink = lineStyle(color, scheme).color;
  return `${(FILLS[dash % FILLS.length] ?? '').replaceAll('ink', ink)}, ${ink}55`;
}

/** What is not data in a chart. */
export const CHART_INK: Readonly<Record<Scheme, { text: string; grid: string; mark: string }>> = {
  light: { text: '#5c6370', grid: '#eceef1', mark: '#7a4894' },
  dark: { text: '#9ba3af', grid: '#262b32', mark: '#cf9ce6' },
};

/** A run state's colour, as text and as line, for each scheme. */
export const STATE_COLORS: Record<RunState, Record<Scheme, string>> = {
  blocked: { light: '#8a5a00', dark: '#e3b341' },
  queued: { light: '#59606b', dark: '#a6adb8' },
  running: { light: '#0062a3', dark: '#62b0ea' },
  paused: { light: '#7a4894', dark: '#cf9ce6' },
  succeeded: { light: '#007350', dark: '#2fc79a' },
  failed: { light: '#b3330d', dark: '#ff8a66' },
  cancelled: { light: '#666b73', dark: '#959ba5' },
};

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

/** Where each method stands among the line styles: it looks the same in every chart, on the page and in figures. */
const METHOD_PLACES: Readonly<Record<string, number>> = {
  'her-sldr': 0,
  her: 1,
  'her-rnd': 2,
  cher: 3,
  'her-dense': 4,
  'ddpg-sldr': 5,
  ddpg: 6,
};

/**
 * The style of a method's curve.
 * @param variant tells groups of one method apart that differ in their settings: same colour, another dash
 */
export function methodStyle(method: string, scheme: Scheme, variant = 0): LineStyle {
  const place = METHOD_PLACES[method] ?? placeOfUnknown(method);
  return { color: lineStyle(place, scheme).color, dash: lineStyle(place + variant, scheme).dash };
}

/** A method that is not in the table gets a style from its name, so it keeps it from day to day. */
function placeOfUnknown(method: string): number {
  return [...method].reduce((sum, letter) => (sum * 31 + letter.charCodeAt(0)) % 9973, 7);
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

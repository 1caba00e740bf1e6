/** Addresses of what can be taken along: figures, the numbers behind them, tables, and the bundle. */
import { choiceOf } from './api/choice';
import { viewOf } from './api/get-curves';
import type { CompareSearch } from './search';

/** How wide a figure is drawn: a paper's column, both, or a slide. */
export const WIDTHS = ['single', 'double', 'slide'] as const;
export type Width = (typeof WIDTHS)[number];

export const FORMATS = ['svg', 'pdf', 'png', 'csv', 'tex'] as const;
export type Format = (typeof FORMATS)[number];

/** The figure that the page shows, drawn for a paper, or its numbers. */
export function figureAddress(search: CompareSearch, format: Format, width: Width): string {
  return `/api/compare/figure.${format}?${question(search, { width })}`;
}

/** Everything of the comparison in one archive. */
export function bundleAddress(search: CompareSearch, width: Width, isAnonymous: boolean): string {
  return `/api/compare/bundle.zip?${question(search, { width, anonymous: isAnonymous })}`;
}

function question(search: CompareSearch, more: Readonly<Record<string, string | boolean>>): string {
  const { logx, logy, tab } = search;
  const look = { kind: tab ?? 'curves', log_x: logx === 'yes', log_y: logy === 'yes' };
  const all = { ...choiceOf(search), ...viewOf(search), ...look, ...more };
  const pairs = Object.entries(all).flatMap(([name, value]): [string, string][] =>
    [value].flat().flatMap((one) => (one === undefined ? [] : [[name, String(one)]])),
  );
  return new URLSearchParams(pairs).toString();
}

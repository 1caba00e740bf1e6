/** What the run page shows, as it stands in the address. */

import { readEpisode } from './scene-choice';

/** The tabs of the run page. */
export const TABS = ['overview', '3d', 'rerun', 'videos', 'config', 'log', 'history', 'files'] as const;
export type Tab = (typeof TABS)[number];

/** What the charts may be drawn over. */
export const AXES = ['epoch', 'env_steps', 'updates', 'wall_seconds'] as const;
export type Axis = (typeof AXES)[number];

/** The most that curves may be smoothed. */
export const MOST_SMOOTHING = 0.99;

export interface RunSearch {
  readonly tab?: Tab;
  readonly x?: Axis;
  readonly smooth?: number;
  /** The recorded episode that the 3D tab shows: `epoch.index`. */
  readonly episode?: string;
}

/** Read the run page's view from an address; what makes no sense is left out. */
export function readRunSearch(raw: Record<string, unknown>): RunSearch {
  const smooth = Number(raw.smooth);
  return {
    tab: TABS.find((tab) => tab === raw.tab),
    x: AXES.find((axis) => axis === raw.x),
    episode: readEpisode(String(raw.episode)) && String(raw.episode),
    smooth: raw.smooth !== undefined && smooth >= 0 && smooth <= MOST_SMOOTHING ? smooth : undefined,
  };
}

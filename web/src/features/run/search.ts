/** What the run page shows, as it stands in the address. */
import { MOST_SMOOTHING } from '@/lib/smoothing';

import { EPISODE_SORTS, type EpisodeSort, readEpisode } from './episodes/place';
import { TAGS, type Tag } from './episodes/tags';

/** The tabs of the run page. */
export const TABS = [
  'overview',
  '3d',
  'demonstrations',
  'episodes',
  'rerun',
  'videos',
  'config',
  'log',
  'history',
  'files',
] as const;
export type Tab = (typeof TABS)[number];

/** What the charts may be drawn over. */
export const AXES = ['epoch', 'env_steps', 'updates', 'wall_seconds'] as const;
export type Axis = (typeof AXES)[number];

export interface RunSearch {
  readonly tab?: Tab;
  readonly x?: Axis;
  readonly smooth?: number;
  /** The recorded episode that is looked at: `epoch.index`. */
  readonly episode?: string;
  /** What the list of episodes is narrowed to: how they ended, and the epoch of their test. */
  readonly tag?: Tag;
  readonly test?: number;
  /** Left out: the newest test first. */
  readonly sort?: EpisodeSort;
  /** Left out: as the key has it. */
  readonly order?: 'up' | 'down';
}

/** Read the run page's view from an address; what makes no sense is left out. */
export function readRunSearch(raw: Record<string, unknown>): RunSearch {
  const smooth = Number(raw.smooth);
  const test = Number(raw.test);
  return {
    tab: TABS.find((tab) => tab === raw.tab),
    x: AXES.find((axis) => axis === raw.x),
    smooth: raw.smooth !== undefined && smooth >= 0 && smooth <= MOST_SMOOTHING ? smooth : undefined,
    episode: readEpisode(raw.episode) === undefined ? undefined : String(raw.episode),
    tag: TAGS.find((tag) => tag === raw.tag),
    test: raw.test !== undefined && Number.isSafeInteger(test) && test >= 0 ? test : undefined,
    sort: EPISODE_SORTS.find((sort) => sort === raw.sort),
    order: raw.order === 'up' || raw.order === 'down' ? raw.order : undefined,
  };
}

/** Where a recorded episode is found, and how a list of them is sorted, as both stand in the address. */
import type { Episode } from '@/client/schema.gen';

/** What episodes can be sorted by, and whether that begins with the largest. */
const STARTS_DESCENDING = { epoch: true, return: false, success: false, worst_q: false } as const;

export type EpisodeSort = keyof typeof STARTS_DESCENDING;

export const EPISODE_SORTS = Object.keys(STARTS_DESCENDING) as readonly EpisodeSort[];

export interface EpisodeSorting {
  readonly sort: EpisodeSort;
  readonly descending: boolean;
}

interface SortSearch {
  readonly sort?: EpisodeSort;
  readonly order?: 'up' | 'down';
}

export function sortingOf({ sort = 'epoch', order }: SortSearch): EpisodeSorting {
  return { sort, descending: order === undefined ? STARTS_DESCENDING[sort] : order === 'down' };
}

/** What to put into the address so that episodes are sorted so. */
export function searchOf({ sort, descending }: EpisodeSorting): SortSearch {
  return {
    sort: sort === 'epoch' ? undefined : sort,
    order: descending === STARTS_DESCENDING[sort] ? undefined : descending ? 'down' : 'up',
  };
}

/** How a list would be sorted after a press on the head of a column. */
export function pressed(now: EpisodeSorting, sort: EpisodeSort): EpisodeSorting {
  return { sort, descending: now.sort === sort ? !now.descending : STARTS_DESCENDING[sort] };
}

export interface EpisodePlace {
  readonly epoch: number;
  readonly index: number;
}

/** Read `epoch.index`; undefined if it is something else. */
export function readEpisode(raw: unknown): EpisodePlace | undefined {
  const found = /^(\d{1,9})\.(\d{1,4})$/.exec(String(raw ?? ''));
  return found ? { epoch: Number(found[1]), index: Number(found[2]) } : undefined;
}

export function episodeName({ epoch, index }: Pick<Episode, 'epoch' | 'index'>): string {
  return `${epoch}.${index}`;
}

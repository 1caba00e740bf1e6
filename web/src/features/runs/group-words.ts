/** Groups in words. */
import type { RunGroup } from '@/client/schema.gen';
import type { GroupKey } from './search';

/** What a key is called where groups are chosen. */
export const GROUP_NAMES: Readonly<Record<GroupKey, string>> = {
  task: 'Task',
  phase: 'Phase',
  method: 'Method',
  preset: 'Preset',
  settings: 'Settings (all but the seed)',
  state: 'State',
};

/** Digits of a hash that a person compares. */
const HASH_DIGITS = 6;

/** What the runs of a group share: `FetchPush · her-sldr · settings 12ab34`. */
export function groupTitle(group: RunGroup, by: readonly GroupKey[]): string {
  return by
    .map((key) => (key === 'settings' ? `settings ${group.keys[key]?.slice(0, HASH_DIGITS)}` : group.keys[key]))
    .join(' · ');
}

/** Seeds with their neighbours together: `0–4, 7`. */
export function formatSeeds(seeds: readonly number[]): string {
  const ranges: [number, number][] = [];
  for (const seed of seeds) {
    const last = ranges.at(-1);
    if (last !== undefined && seed === last[1] + 1) last[1] = seed;
    else ranges.push([seed, seed]);
  }
  return ranges.map(([from, to]) => (from === to ? `${from}` : `${from}–${to}`)).join(', ');
}

/** What the table is narrowed to, one chip each, to be taken away. */
import { Button, CloseButton } from '@mantine/core';
import { formatShare } from '@/lib/format';
import type { RunsFilter } from '../search';
import classes from './runs.module.css';

interface Props {
  search: RunsFilter;
  onChange: (changes: RunsFilter) => void;
}

export function FilterChips({ search, onChange }: Props) {
  const filters = filtersOf(search);
  if (filters.length === 0) return null;
  const cleared = Object.fromEntries(filters.flatMap(({ keys }) => keys.map((key) => [key, undefined])));
  return (
    <ul className={classes.chips} aria-label="Filters">
      {filters.map(({ text, keys }) => (
        <li key={text} className={classes.chip}>
          {text}
          <CloseButton
            size="xs"
            radius="xl"
            aria-label={`Remove the filter ${text}`}
            onClick={() => onChange(Object.fromEntries(keys.map((key) => [key, undefined])))}
          />
        </li>
      ))}
      <li>
        <Button variant="subtle" size="compact-xs" onClick={() => onChange(cleared)}>
          Clear all
        </Button>
      </li>
    </ul>
  );
}

interface FilterWords {
  readonly text: string;
  readonly keys: readonly (keyof RunsFilter)[];
}

/** The filters in words; the search field shows its own. */
export function filtersOf(search: RunsFilter): FilterWords[] {
  const lists = [
    ['state', 'state'],
    ['task', 'task'],
    ['phase', 'phase'],
    ['method', 'method'],
    ['preset', 'preset'],
    ['tag', 'tagged'],
    ['any_tag', 'tagged any of'],
    ['no_tag', 'not tagged'],
  ] as const;
  const words = lists.flatMap(([key, name]): FilterWords[] =>
    search[key] === undefined ? [] : [{ text: `${name} ${search[key].join(', ')}`, keys: [key] }],
  );
  if (search.settings !== undefined)
    words.push({ text: `settings ${search.settings.slice(0, 6)}`, keys: ['settings'] });
  const seeds = rangeWords(search.seed_from, search.seed_to, String);
  if (seeds !== null) words.push({ text: `seed ${seeds}`, keys: ['seed_from', 'seed_to'] });
  const success = rangeWords(search.success_from, search.success_to, (share) => formatShare(share));
  if (success !== null) words.push({ text: `success ${success}`, keys: ['success_from', 'success_to'] });
  if (search.deleted) words.push({ text: 'deleted', keys: ['deleted'] });
  return words;
}

function rangeWords(from: number | undefined, to: number | undefined, shown: (bound: number) => string): string | null {
  if (from !== undefined && to !== undefined) return from === to ? shown(from) : `${shown(from)} to ${shown(to)}`;
  if (from !== undefined) return `from ${shown(from)}`;
  return to === undefined ? null : `up to ${shown(to)}`;
}

/** What the table is sorted by, where no head of a column can be clicked: among cards, and of groups. */
import { ActionIcon, Select } from '@mantine/core';
import { Icon } from '@/components/icon';
import { BUILT_IN_KEYS, BUILT_INS } from '../columns';
import { GROUP_NAMES } from '../group-words';
import { parseMetricColumn, statisticName } from '../metric-columns';
import type { RunsSearch } from '../search';
import { groupSortingOf, isLargestFirst, runSortingOf, searchOf } from '../sorting';
import classes from './runs.module.css';

interface Props {
  search: RunsSearch;
  onChange: (changes: RunsSearch) => void;
}

export function SortField({ search, onChange }: Props) {
  const sorting = search.group === undefined ? runSortingOf(search) : groupSortingOf(search);
  return (
    <span className={classes.line}>
      <Select
        size="xs"
        className={classes.sortField}
        aria-label="Sort by"
        data={search.group === undefined ? runSorts(search) : groupSorts(search)}
        value={sorting.sort}
        onChange={(sort) => sort && onChange(searchOf({ sort, descending: isLargestFirst(sort) }))}
      />
      <ActionIcon
        variant="default"
        size={30}
        aria-label={sorting.descending ? 'Smallest first' : 'Largest first'}
        onClick={() => onChange(searchOf({ ...sorting, descending: !sorting.descending }))}
      >
        <Icon name={sorting.descending ? 'down' : 'up'} size={14} />
      </ActionIcon>
    </span>
  );
}

interface Choice {
  readonly value: string;
  readonly label: string;
}

function runSorts(search: RunsSearch): Choice[] {
  const builtIns = BUILT_IN_KEYS.filter((key) => BUILT_INS[key].isSortable).map((key) => ({
    value: key,
    label: `By ${BUILT_INS[key].name.toLowerCase()}`,
  }));
  const metrics = (search.columns ?? []).flatMap((text): Choice[] => {
    const column = parseMetricColumn(text);
    return column === null ? [] : [{ value: text, label: `By ${column.name}, ${statisticName(column)}` }];
  });
  return [...builtIns, ...metrics];
}

function groupSorts({ group = [] }: RunsSearch): Choice[] {
  const keys = group.map((key) => ({ value: key, label: `By ${GROUP_NAMES[key].split(' ')[0]?.toLowerCase()}` }));
  return [
    { value: 'launched', label: 'By newest run' },
    { value: 'median', label: 'By median' },
    { value: 'runs', label: 'By number of runs' },
    ...keys,
  ];
}

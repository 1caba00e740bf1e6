/** Put runs in groups: by anything but the seed, with the spread of one metric. */
import { Button, Checkbox, FocusTrap, Popover } from '@mantine/core';
import { Suspense } from 'react';
import { USUAL_SPREAD } from '../api/list-groups';
import { GROUP_NAMES } from '../group-words';
import { parseMetricColumn, statisticName } from '../metric-columns';
import { ALL_BUT_SEED, GROUP_KEYS, type GroupKey, type RunsSearch } from '../search';
import { MetricPicker } from './lazy-parts';
import classes from './runs.module.css';

interface Props {
  search: RunsSearch;
  onChange: (changes: RunsSearch) => void;
}

export function GroupChooser({ search, onChange }: Props) {
  const { group = [] } = search;
  // The keys of the open groups are those of the grouping, so another grouping has none open.
  const by = (keys: readonly GroupKey[]): void =>
    onChange({ group: keys.length === 0 ? undefined : keys, open: undefined });
  const spread = parseMetricColumn(search.spread ?? USUAL_SPREAD);
  return (
    <Popover position="bottom-start" shadow="md" trapFocus>
      <Popover.Target>
        <Button variant={group.length > 0 ? 'light' : 'default'} size="xs">
          {group.length > 0 ? 'Grouped' : 'Group'}
        </Button>
      </Popover.Target>
      <Popover.Dropdown>
        <div className={classes.choices}>
          <FocusTrap.InitialFocus />
          <div className={classes.line}>
            <Button size="compact-xs" variant="light" onClick={() => by(ALL_BUT_SEED)}>
              All but the seed
            </Button>
            <Button size="compact-xs" variant="subtle" disabled={group.length === 0} onClick={() => by([])}>
              No groups
            </Button>
          </div>
          {GROUP_KEYS.map((key) => (
            <Checkbox
              key={key}
              size="xs"
              label={GROUP_NAMES[key]}
              checked={group.includes(key)}
              onChange={(event) => {
                const isWanted = event.currentTarget.checked;
                by(GROUP_KEYS.filter((one) => (one === key ? isWanted : group.includes(one))));
              }}
            />
          ))}
          {group.length > 0 && spread && (
            <>
              <h3 className={classes.heading}>Median and quartiles of</h3>
              <span>
                {spread.name}, {statisticName(spread)}
              </span>
              <Suspense fallback={null}>
                <MetricPicker action="Show this one" onPick={(text) => onChange({ spread: text })} />
              </Suspense>
            </>
          )}
        </div>
      </Popover.Dropdown>
    </Popover>
  );
}

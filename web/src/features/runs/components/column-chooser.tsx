/** Choose columns: those every run has, and any metric as its newest value, its best, or the mean of its last ones. */
import { Button, Checkbox, CloseButton, FocusTrap, Popover } from '@mantine/core';
import { Suspense } from 'react';
import { BUILT_IN_KEYS, BUILT_INS, shownColumns, withColumn } from '../columns';
import { parseMetricColumn, statisticName } from '../metric-columns';
import { MOST_METRIC_COLUMNS, type RunsSearch } from '../search';
import { MetricPicker } from './lazy-parts';
import classes from './runs.module.css';

interface Props {
  search: RunsSearch;
  /** Whether there is a table; cards always show the same figures, and the metrics. */
  hasTable: boolean;
  onChange: (changes: RunsSearch) => void;
}

export function ColumnChooser({ search, hasTable, onChange }: Props) {
  const { columns = [] } = search;
  const shown = shownColumns(search.show);
  const show = (chosen: readonly string[]): void => onChange({ columns: chosen.length === 0 ? undefined : chosen });
  return (
    <Popover position="bottom-start" shadow="md" trapFocus>
      <Popover.Target>
        <Button variant="default" size="xs">
          Columns
        </Button>
      </Popover.Target>
      <Popover.Dropdown>
        <div className={classes.choices}>
          <FocusTrap.InitialFocus />
          {hasTable && (
            <div className={classes.checks}>
              {BUILT_IN_KEYS.filter((key) => key !== 'task').map((key) => (
                <Checkbox
                  key={key}
                  size="xs"
                  label={BUILT_INS[key].name}
                  checked={shown.includes(key)}
                  onChange={(event) => onChange({ show: withColumn(key, event.currentTarget.checked, search.show) })}
                />
              ))}
            </div>
          )}
          <h3 className={classes.heading}>Metrics</h3>
          {columns.map((text) => (
            <ChosenMetric key={text} text={text} onRemove={() => show(columns.filter((one) => one !== text))} />
          ))}
          {columns.length < MOST_METRIC_COLUMNS && (
            <Suspense fallback={null}>
              <MetricPicker action="Add" onPick={(text) => show([...new Set([...columns, text])])} />
            </Suspense>
          )}
        </div>
      </Popover.Dropdown>
    </Popover>
  );
}

function ChosenMetric({ text, onRemove }: { text: string; onRemove: () => void }) {
  const column = parseMetricColumn(text);
  if (column === null) return null;
  const words = `${column.name}, ${statisticName(column)}`;
  return (
    <div className={classes.line}>
      <span>{words}</span>
      <CloseButton size="sm" aria-label={`Remove the column ${words}`} onClick={onRemove} />
    </div>
  );
}

/** Choose columns: those every run has, and any metric as its newest value, its best, or the mean of its last ones. */
import { Button, Checkbox, CloseButton, FocusTrap, NumberInput, Popover, Select } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import { metricNamesQuery } from '../api/metric-names';
import { BUILT_IN_KEYS, BUILT_INS, shownColumns, withColumn } from '../columns';
import {
  LONGEST_WINDOW,
  type MetricColumn,
  parseMetricColumn,
  statisticName,
  writeMetricColumn,
} from '../metric-columns';
import { MOST_METRIC_COLUMNS, type RunsSearch } from '../search';
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
            <MetricPicker action="Add" onPick={(text) => show([...new Set([...columns, text])])} />
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

const STATISTICS = [
  { value: 'last', label: 'Newest value' },
  { value: 'best', label: 'Best value' },
  { value: 'mean', label: 'Mean of the last' },
];

interface PickerProps {
  /** What the button says. */
  action: string;
  onPick: (text: string) => void;
}

/** A metric and what is wanted of it. */
export function MetricPicker({ action, onPick }: PickerProps) {
  const { data } = useQuery(metricNamesQuery);
  const [name, setName] = useState<string | null>(null);
  const [statistic, setStatistic] = useState<MetricColumn['statistic']>('last');
  const [window, setWindow] = useState(5);
  return (
    <>
      <Select
        size="xs"
        label="Metric"
        placeholder="Choose one"
        data={data?.names ?? []}
        value={name}
        onChange={setName}
        comboboxProps={{ withinPortal: false }}
        nothingFoundMessage="No run has logged such a metric yet"
        searchable
      />
      <div className={classes.pair}>
        <Select
          size="xs"
          label="Shown as"
          data={STATISTICS}
          value={statistic}
          onChange={(value) => setStatistic((value ?? 'last') as MetricColumn['statistic'])}
          comboboxProps={{ withinPortal: false }}
        />
        {statistic === 'mean' && (
          <NumberInput
            size="xs"
            label="Values"
            min={1}
            max={LONGEST_WINDOW}
            clampBehavior="strict"
            allowDecimal={false}
            value={window}
            onChange={(value) => setWindow(Number(value) || 1)}
          />
        )}
      </div>
      <Button
        variant="light"
        size="xs"
        disabled={name === null}
        onClick={() => name !== null && onPick(writeMetricColumn({ name, statistic, window }))}
      >
        {action}
      </Button>
    </>
  );
}

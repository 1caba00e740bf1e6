/** Choose a metric and what is wanted of it: its newest value, its best, or the mean of its last ones. */
import { Button, NumberInput, Select } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import { metricNamesQuery } from '../api/metric-names';
import { LONGEST_WINDOW, type MetricColumn, writeMetricColumn } from '../metric-columns';
import classes from './runs.module.css';

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

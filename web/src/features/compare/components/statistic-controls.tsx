/** What is made of the seeds, and how sure its interval is. */
import { SegmentedControl, Select } from '@mantine/core';
import { type CompareSearch, LEVELS, STATISTICS, type Statistic, USUAL_LEVEL } from '../search';

const STATISTIC_NAMES: Record<Statistic, string> = {
  median: 'Median',
  mean: 'Mean',
  iqm: 'IQM',
  seeds: 'Each seed',
};

/** The median's band are the quartiles; the others' is an interval of confidence, so that its level can be chosen. */
const WITH_LEVEL: readonly Statistic[] = ['mean', 'iqm'];

interface Props {
  search: CompareSearch;
  onShow: (changes: CompareSearch) => void;
  /** Whether other intervals on the page have a level, whatever the statistic. */
  hasLevel?: boolean;
}

export function StatisticControls({ search, onShow, hasLevel = false }: Props) {
  const statistic = search.statistic ?? 'median';
  return (
    <>
      <SegmentedControl
        size="xs"
        aria-label="Statistic"
        value={statistic}
        onChange={(next) => onShow({ statistic: next === 'median' ? undefined : (next as Statistic) })}
        data={STATISTICS.map((value) => ({ value, label: STATISTIC_NAMES[value] }))}
      />
      {(hasLevel || WITH_LEVEL.includes(statistic)) && (
        <Select
          size="xs"
          w={128}
          aria-label="Confidence level"
          data={LEVELS.map((value) => ({ value: String(value), label: `${value * 100} % interval` }))}
          value={String(search.level ?? USUAL_LEVEL)}
          onChange={(next) => onShow({ level: Number(next) === USUAL_LEVEL ? undefined : Number(next) })}
        />
      )}
    </>
  );
}

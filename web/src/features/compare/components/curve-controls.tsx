/** How the curves are looked at: metric, statistic, axes, smoothing. */
import { Button, Checkbox, Select } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { SmoothingSlider } from '@/components/smoothing-slider';
import { AXIS_NAMES, type Axis } from '@/lib/axes';
import { comparedMetricsQuery } from '../api/get-curves';
import { AXES, type CompareSearch, USUAL_METRIC } from '../search';
import classes from './controls.module.css';
import { StatisticControls } from './statistic-controls';

interface Props {
  search: CompareSearch;
  onShow: (changes: CompareSearch) => void;
}

export function CurveControls({ search, onShow }: Props) {
  const statistic = search.statistic ?? 'median';
  const { data } = useQuery(comparedMetricsQuery(search));
  const metric = search.metric ?? USUAL_METRIC;
  const metrics = [...new Set([...(data?.metrics ?? []), metric])].sort();
  return (
    <div className={classes.row}>
      <Select
        size="xs"
        className={classes.metric}
        aria-label="Metric"
        searchable
        data={metrics}
        value={metric}
        onChange={(next) => onShow({ metric: next === USUAL_METRIC ? undefined : (next ?? undefined) })}
      />
      <StatisticControls search={search} onShow={onShow} />
      <Select
        size="xs"
        w={118}
        aria-label="X axis"
        data={AXES.map((value) => ({ value, label: AXIS_NAMES[value] }))}
        value={search.x ?? 'epoch'}
        onChange={(next) =>
          onShow({ x: next === 'epoch' ? undefined : (next as Axis), from: undefined, to: undefined })
        }
      />
      <SmoothingSlider
        weight={search.smooth ?? 0}
        onWeight={(next) => onShow({ smooth: next === 0 ? undefined : next })}
      />
      <div className={classes.flags}>
        <Flag label="Log x" name="logx" search={search} onShow={onShow} />
        <Flag label="Log y" name="logy" search={search} onShow={onShow} />
        {statistic !== 'seeds' && (
          <>
            <Flag label="Seeds behind" name="seeds" search={search} onShow={onShow} />
            <Flag label="Drop ended runs" name="drop" search={search} onShow={onShow} />
          </>
        )}
        {(statistic === 'seeds' || search.seeds === 'yes') && (
          <Checkbox
            size="xs"
            label="Point at single runs"
            checked={search.hover === 'run'}
            onChange={(event) => onShow({ hover: event.currentTarget.checked ? 'run' : undefined })}
          />
        )}
      </div>
      {search.from === undefined ? (
        <span className={`faint ${classes.hint}`}>Drag in a panel to zoom all of them; a double click shows all.</span>
      ) : (
        <Button variant="light" size="compact-xs" onClick={() => onShow({ from: undefined, to: undefined })}>
          Show all and follow
        </Button>
      )}
    </div>
  );
}

interface FlagProps extends Props {
  label: string;
  name: 'logx' | 'logy' | 'seeds' | 'drop';
}

function Flag({ label, name, search, onShow }: FlagProps) {
  return (
    <Checkbox
      size="xs"
      label={label}
      checked={search[name] === 'yes'}
      onChange={(event) => onShow({ [name]: event.currentTarget.checked ? 'yes' : undefined })}
    />
  );
}

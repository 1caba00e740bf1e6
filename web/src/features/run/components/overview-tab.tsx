/** What differs in this run, and its curves, live. */
import { useLocalStorage } from '@mantine/hooks';
import { useQuery, useQueryClient } from '@tanstack/react-query';
import { useCallback, useMemo, useState } from 'react';
import type { MetricBatch, RunDetail } from '@/client/schema.gen';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatName } from '@/lib/format';
import type { Metrics } from '@/lib/metrics';
import { valueAt } from '@/lib/settings';
import { hasEnded } from '@/lib/states';
import { scaled } from '@/lib/zoom';
import { metricsQuery } from '../api/get-metrics';
import { attemptMarks } from '../attempt-marks';
import { chartSections, successChart, xColumn } from '../charts';
import type { RunSearch } from '../search';
import { ChartControls } from './chart-controls';
import classes from './charts.module.css';
import { type ChartView, MetricChart } from './metric-chart';
import { RunDifferences } from './run-differences';
import { WaitingPanel } from './waiting-panel';

interface Props {
  run: RunDetail;
  search: RunSearch;
  onShow: (changes: RunSearch) => void;
}

export function OverviewTab(props: Props) {
  return (
    <>
      <RunDifferences run={props.run} />
      <Progress {...props} />
    </>
  );
}

function Progress({ run, search, onShow }: Props) {
  const queries = useQueryClient();
  const { data: metrics, error } = useQuery(metricsQuery(queries, run.id, !hasEnded(run.state)));
  if (metrics === undefined) {
    return error ? (
      <SentencePanel urgent title="The curves cannot be shown">
        {sentence(error)}
      </SentencePanel>
    ) : null;
  }
  if (metrics.step.length === 0) return <NoCurves run={run} />;
  return <Curves run={run} metrics={metrics} search={search} onShow={onShow} />;
}

function Curves({ run, metrics, search, onShow }: Props & { metrics: Metrics }) {
  const axis = search.x ?? 'epoch';
  const weight = search.smooth ?? 0;
  const [zoom, setZoom] = useState<readonly [number, number] | null>(null);
  const cyclesPerEpoch = Number(valueAt(run.config, 'loop.cycles_per_epoch')) || 1;
  const placeOf = useCallback((part: MetricBatch) => xColumn(part, axis, cyclesPerEpoch), [axis, cyclesPerEpoch]);
  const x = useMemo(() => placeOf(metrics), [metrics, placeOf]);
  const names = Object.keys(metrics.values).sort().join('\n');
  const success = useMemo(() => successChart(names.split('\n')), [names]);
  const sections = useMemo(() => chartSections(names.split('\n')), [names]);
  const marks = useMemo(() => attemptMarks(metrics, placeOf), [metrics, placeOf]);
  const whole = [0, x.at(-1) || 1] as const;
  const range = zoom ?? whole;
  const view: ChartView = { metrics, x, placeOf, axis, weight, marks, range, whole, onZoom: setZoom };
  return (
    <>
      <ChartControls
        axis={axis}
        weight={weight}
        isZoomed={zoom !== null}
        onAxis={(next) => {
          setZoom(null);
          onShow({ x: next === 'epoch' ? undefined : next });
        }}
        onWeight={(next) => onShow({ smooth: next === 0 ? undefined : next })}
        onZoom={(factor) => setZoom(scaled(range, whole, (range[0] + range[1]) / 2, factor))}
        onReset={() => setZoom(null)}
      />
      {success.series.length > 0 && <MetricChart chart={success} view={view} height={250} />}
      <div className={classes.sections}>
        {sections.map((section) => (
          <Section key={section.name} name={section.name}>
            {section.charts.map((chart) => (
              <MetricChart key={chart.id} chart={chart} view={view} height={170} />
            ))}
          </Section>
        ))}
      </div>
    </>
  );
}

function Section({ name, children }: { name: string; children: React.ReactNode[] }) {
  const [isOpen, setOpen] = useLocalStorage({
    key: `sldr-charts-${name}`,
    defaultValue: name !== 'progress',
    getInitialValueInEffect: false,
  });
  return (
    <details
      className={classes.section}
      style={{ '--charts': children.length } as React.CSSProperties}
      open={isOpen}
      onToggle={(event) => setOpen(event.currentTarget.open)}
    >
      <summary>
        {formatName(name)} <span className="faint">{children.length}</span>
      </summary>
      {isOpen && <div className={classes.grid}>{children}</div>}
    </details>
  );
}

function NoCurves({ run }: { run: RunDetail }) {
  if (run.state === 'blocked' && run.needs.length > 0) return <WaitingPanel run={run} />;
  const words: Partial<Record<RunDetail['state'], string>> = {
    blocked: 'The run waits for its locomotion model; its curves appear here once it trains.',
    queued: 'The run waits for a free worker; its curves appear here once it trains.',
    running: 'The first cycle is under way; its numbers appear here in a few seconds.',
    paused: 'The run is held before its first cycle; its curves appear here once it has been resumed and trains.',
    // No training succeeds without a cycle: only a model of the zoo has none, here or where it was imported from.
    succeeded: 'Its model came with the product; it was not trained here.',
  };
  return (
    <SentencePanel title={hasEnded(run.state) ? 'No curves' : 'No curves yet'}>
      {words[run.state] ?? 'The run ended before its first cycle.'}
    </SentencePanel>
  );
}

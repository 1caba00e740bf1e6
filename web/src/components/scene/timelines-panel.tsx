/** The charts below a 3D view, asked for again whenever the episode shown has changed or grown. */
import { Button, useComputedColorScheme } from '@mantine/core';
import { useEffect, useMemo, useRef, useState } from 'react';
import { type Timeline, timelineCharts, worstQStep } from '@/lib/timelines';
import type { Scene } from '@/lib/use-scene-control';
import classes from './scene.module.css';
import { TimelineChartView } from './timeline-chart';

/** While an episode grows, its curves are asked for at most this often [ms]. */
const GROWING_MS = 400;

export function TimelinesPanel({ scene }: { scene: Scene }) {
  const scheme = useComputedColorScheme('light');
  const timeline = useTimeline(scene);
  const charts = useMemo(() => (timeline === undefined ? [] : timelineCharts(timeline)), [timeline]);
  const worst = useMemo(() => (timeline === undefined ? undefined : worstQStep(timeline)), [timeline]);
  const { state, tell } = scene;
  if (state === undefined || timeline === undefined) return null;
  const seek = (step: number): void => {
    tell({ do: 'pause' });
    tell({ do: 'seek', step });
  };
  return (
    <section className={`card ${classes.timelines}`} aria-label="Timelines">
      <div className={classes.timelinesHead}>
        <span className="faint">Click or drag in a chart to go to that step.</span>
        {worst !== undefined && (
          <Button size="compact-xs" variant="default" onClick={() => seek(worst)}>
            Go to the worst q
          </Button>
        )}
      </div>
      {!charts.some(({ group }) => group === 'value') && (
        <p className="faint">There is no curve of Q: a live policy comes without critics. Recorded episodes have it.</p>
      )}
      {charts.map((chart) => (
        <TimelineChartView
          key={chart.group}
          chart={chart}
          step={state.step}
          steps={state.steps}
          scheme={scheme}
          onSeek={seek}
        />
      ))}
    </section>
  );
}

function useTimeline({ state, ask }: Scene): Timeline | undefined {
  const [timeline, setTimeline] = useState<Timeline>();
  const askedAt = useRef(0);
  const version = state?.timeline;
  const known = state?.known;
  // biome-ignore lint/correctness/useExhaustiveDependencies: asked again for what these two tell to be new
  useEffect(() => {
    if (version === undefined) return;
    const wait = Math.max(0, askedAt.current + GROWING_MS - Date.now());
    const timer = setTimeout(() => {
      askedAt.current = Date.now();
      // A connection that is lost meanwhile is renewed, and its first state asks again.
      ask<Timeline>({ do: 'timeline' }).then(setTimeline, () => undefined);
    }, wait);
    return () => clearTimeout(timer);
  }, [version, known, ask]);
  return timeline;
}

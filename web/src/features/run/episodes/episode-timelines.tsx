/** What happened in one episode, step by step, and what the streams and critics said of it. */
import { useComputedColorScheme } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useMemo, useState } from 'react';
import type { EpisodeTimelines as Timelines } from '@/client/schema.gen';
import { ButtonLink } from '@/components/anchor-link';
import { Icon } from '@/components/icon';
import { LineChart } from '@/components/line-chart';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatValue } from '@/lib/format';
import { lineStyle } from '@/lib/palette';
import type { Range } from '@/lib/zoom';
import { EpisodeVideos } from '../components/episode-videos';
import classes from './episodes.module.css';
import { timelinesQuery } from './get-episodes';
import { type EpisodePlace, episodeName } from './place';
import { TagBadge } from './tag-badge';
import { momentsOf, Q_TITLE, type Timeline, timelinesOf } from './timelines';

const HEIGHT = 130; // [px]

export function EpisodeTimelines({ runId, place }: { runId: string; place: EpisodePlace }) {
  const { data, error } = useQuery(timelinesQuery(runId, place));
  if (error) {
    return (
      <SentencePanel urgent title={`Episode ${episodeName(place)} cannot be shown`}>
        {sentence(error)}
      </SentencePanel>
    );
  }
  return data ? <Shown runId={runId} timelines={data} /> : null;
}

function Shown({ runId, timelines }: { runId: string; timelines: Timelines }) {
  const { episode } = timelines;
  const [zoom, setZoom] = useState<Range | null>(null);
  const x = useMemo(() => momentsOf(timelines), [timelines]);
  const charts = useMemo(() => timelinesOf(timelines), [timelines]);
  const marks = useMemo(
    () => (episode.worst_q_step === null ? [] : [{ x: episode.worst_q_step, label: 'worst q' }]),
    [episode],
  );
  const whole = [0, episode.length] as const;
  const view = { x, marks: NO_MARKS, range: zoom ?? whole, whole, onZoom: setZoom };
  return (
    <section className={classes.episode} aria-label={`Episode ${episodeName(episode)}`}>
      <div className={classes.episodeHead}>
        <h2>
          Epoch {episode.epoch}, episode {episode.index}
        </h2>
        <TagBadge tag={episode.tag} />
        <span className="faint number">
          return {formatValue(episode.task_return)}
          {episode.worst_q !== null && ` · worst q ${formatValue(episode.worst_q)} at step ${episode.worst_q_step}`}
        </span>
        <ButtonLink
          from="/runs/$runId"
          to="/runs/$runId"
          params={{ runId }}
          search={(old) => ({ ...old, tab: '3d', episode: episodeName(episode) })}
          size="compact-sm"
          ml="auto"
          leftSection={<Icon name="cube" size={14} />}
        >
          Watch in 3D
        </ButtonLink>
      </div>
      <p className={`faint ${classes.again}`}>
        {episode.resimulates
          ? 'Simulated again from its start and actions alone, it came to the same states, to the last bit.'
          : 'Simulated again from its start and actions alone, it came to other states; shown is what was recorded.'}
      </p>
      <EpisodeVideos runId={runId} epoch={episode.epoch} number={episode.index} />
      <div className={classes.timelines}>
        {charts.map((chart) => (
          <TimelineChart key={chart.title} chart={chart} view={chart.title === Q_TITLE ? { ...view, marks } : view} />
        ))}
      </div>
    </section>
  );
}

interface View {
  readonly x: readonly number[];
  readonly marks: readonly { readonly x: number; readonly label: string }[];
  readonly range: Range;
  readonly whole: Range;
  readonly onZoom: (range: Range | null) => void;
}

const NO_MARKS: readonly never[] = [];
const NO_GHOSTS: readonly never[] = [];
const formatStep = (step: number): string => String(Number(step.toFixed(1)));

function TimelineChart({ chart, view }: { chart: Timeline; view: View }) {
  const scheme = useComputedColorScheme('light');
  const [point, setPoint] = useState<number | null>(null);
  const { title, lines, format } = chart;
  const at = point ?? view.x.length - 1;
  const valueAt = (line: Timeline['lines'][number], step: number): string => format(line.raw[step] ?? null);
  return (
    <figure className={`card ${classes.timeline}`} aria-label={title}>
      <figcaption>
        <h3>{title}</h3>
        <ul className={classes.legend}>
          {lines.map((line, index) => {
            const { color, dash } = lineStyle(index, scheme);
            return (
              <li key={line.label}>
                {lines.length > 1 && (
                  <svg width="18" height="8" aria-hidden="true">
                    <path d="M0 4h18" stroke={color} strokeWidth="2" strokeDasharray={dash.join(' ')} />
                  </svg>
                )}
                {lines.length > 1 && line.label} <b className="number">{point !== null && valueAt(line, at)}</b>
              </li>
            );
          })}
          {point !== null && <li className="faint number">step {view.x[at]}</li>}
        </ul>
      </figcaption>
      <LineChart
        {...view}
        lines={lines}
        scheme={scheme}
        height={HEIGHT}
        isShare={false}
        isSmoothed={false}
        formatX={formatStep}
        formatY={format}
        ghosts={NO_GHOSTS}
        onPoint={setPoint}
        description={`${title} over the steps of the episode`}
        describePoint={(step) =>
          `step ${view.x[step]}: ${lines.map((line) => `${line.label} ${valueAt(line, step)}`).join(', ')}`
        }
      />
    </figure>
  );
}

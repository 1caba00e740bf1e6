/** Success and time to goal over the space of starts and goals. */
import { NativeSelect, SegmentedControl } from '@mantine/core';
import { useState } from 'react';
import { HeatMap } from '@/components/heat-map';
import { formatPlural, formatShare, NOTHING } from '@/lib/format';
import type { Scene } from '@/lib/use-scene-control';
import type { About, CoverageAnswer, FanState } from './answers';
import classes from './inspector.module.css';
import { ALL_LAYERS, type Measure, mapCells, onLayer } from './map-cells';
import { useAnswer } from './use-answer';

interface Props {
  scene: Scene;
  fan: FanState;
  about: About;
}

export function MapPanel({ scene, fan, about }: Props) {
  const [space, setSpace] = useState(about.spaces[0]?.name ?? '');
  const [measure, setMeasure] = useState<Measure>('success');
  const [layer, setLayer] = useState(ALL_LAYERS);
  const covered = useAnswer<CoverageAnswer>(scene, { do: 'map', space }, fan.version);
  return (
    <section className={`card ${classes.panel}`} aria-label="Map of success">
      <h2>Where it succeeds</h2>
      <div className={classes.row}>
        <NativeSelect
          size="xs"
          aria-label="Map over"
          value={space}
          data={about.spaces.map(({ name, title }) => ({ value: name, label: title }))}
          onChange={(event) => {
            setSpace(event.currentTarget.value);
            setLayer(ALL_LAYERS);
          }}
        />
        <SegmentedControl
          size="xs"
          aria-label="What is shown"
          value={measure}
          onChange={(value) => setMeasure(value as Measure)}
          data={[
            { value: 'success', label: 'Success' },
            { value: 'time', label: 'Time to goal' },
          ]}
        />
        {covered && covered.layer.names.length > 1 && (
          <NativeSelect
            size="xs"
            aria-label={`Which ${covered.layer.name}`}
            value={String(layer)}
            data={[
              { value: String(ALL_LAYERS), label: `every ${covered.layer.name}` },
              ...covered.layer.names.map((name, at) => ({ value: String(at), label: name })),
            ]}
            onChange={(event) => setLayer(Number(event.currentTarget.value))}
          />
        )}
      </div>
      {covered && covered.episodes.length > 0 && (
        <Covered covered={covered} measure={measure} layer={layer} about={about} />
      )}
    </section>
  );
}

function Covered(props: { covered: CoverageAnswer; measure: Measure; layer: number; about: About }) {
  const { covered, measure, layer, about } = props;
  const shown = onLayer(covered, layer);
  const isSuccess = measure === 'success';
  return (
    <HeatMap
      description={`${isSuccess ? 'Success' : 'Median time to goal'} over ${covered.title}.`}
      x={covered.x}
      y={covered.y}
      cells={mapCells(shown, measure)}
      scale={about.scale}
      range={isSuccess ? [0, 1] : undefined}
      format={isSuccess ? (value) => formatShare(value) : formatSeconds}
      tell={(column, row) => {
        const [done, successes] = [shown.episodes[row]?.[column] ?? 0, shown.successes[row]?.[column] ?? 0];
        return `${successes} of ${formatPlural(done, 'demonstration')}`;
      }}
      isWritten
    />
  );
}

function formatSeconds(value: number | null): string {
  return value === null ? NOTHING : `${value.toFixed(2)}\u202fs`;
}

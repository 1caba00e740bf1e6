/** What the object's critic makes of the moment: a slice of Q as a heat map, and the same in the scene. */
import { Button, NativeSelect } from '@mantine/core';
import { HeatMap } from '@/components/heat-map';
import { formatValue } from '@/lib/format';
import { axisOfPoints } from '@/lib/heat-map';
import type { Scene } from '@/lib/use-scene-control';
import type { About, InspectorState, SliceAnswer } from './answers';
import classes from './inspector.module.css';
import { useAnswer } from './use-answer';

interface Props {
  scene: Scene;
  state: InspectorState;
  about: About;
}

/** The table of a slice shows every third row and column: it is smooth. */
const TABLE_EVERY = 3;

export function SlicePanel({ scene, state, about }: Props) {
  const { slice, looks } = state;
  const choose = (changes: Partial<InspectorState['slice']>): void => {
    const { kind, plane, body, part } = { ...slice, ...changes };
    scene.tell({ do: 'choose-slice', kind, plane, body, part });
  };
  const known = about.slices.find(({ kind }) => kind === slice.kind);
  return (
    <section className={`card ${classes.panel}`} aria-label="Slice of Q">
      <h2>What its critic thinks</h2>
      <div className={classes.row}>
        <Choice
          label="Slice of Q"
          value={slice.kind}
          options={about.slices.map(({ kind, title }) => [kind, title])}
          onChoose={(kind) => choose({ kind, plane: 0 })}
        />
        {known && known.planes.length > 1 && (
          <Choice
            label="Plane"
            value={String(slice.plane)}
            options={known.planes.map(([across, up], at) => [String(at), `${across}, ${up}`])}
            onChoose={(plane) => choose({ plane: Number(plane) })}
          />
        )}
        {about.bodies > 1 && slice.kind === 'action' && (
          <Choice
            label="End of the chain"
            value={String(slice.body)}
            options={[
              ['0', 'first block'],
              ['1', 'last block'],
            ]}
            onChoose={(body) => choose({ body: Number(body) })}
          />
        )}
        {about.objects.length > 1 && (
          <Choice
            label="Object"
            value={String(slice.part)}
            options={about.objects.map((name, at) => [String(at), name])}
            onChoose={(part) => choose({ part: Number(part) })}
          />
        )}
      </div>
      {looks.surface ? (
        <Landscape scene={scene} version={slice.version} about={about} />
      ) : (
        <Button mt={8} size="xs" variant="default" onClick={() => choose({})}>
          Show Q
        </Button>
      )}
    </section>
  );
}

function Landscape({ scene, version, about }: { scene: Scene; version: number; about: About }) {
  const told = useAnswer<SliceAnswer>(scene, { do: 'slice' }, version);
  if (told === undefined) return null;
  return (
    <>
      <HeatMap
        description={`Q at this moment: ${told.title}, over ${told.axes.join(' and ')}.`}
        x={axisOfPoints(told.axes[0], told.unit, told.across)}
        y={axisOfPoints(told.axes[1], told.unit, told.up)}
        cells={told.value}
        scale={about.scale}
        format={formatValue}
        mark={told.here}
        tableEvery={TABLE_EVERY}
      />
      <p className="faint">
        The ring is how it is now: Q is <b className="number">{formatValue(told.now)}</b>. {MEANING[told.kind]}
      </p>
    </>
  );
}

/** What the colours say. */
const MEANING: Readonly<Record<string, string>> = {
  position: 'Bright places are those from which the goal is near, in steps.',
  goal: 'Bright places are goals that are near from here, in steps.',
  turn: 'The middle is how it is turned now; the way from it is the axis, its length the angle of another turn.',
  action: 'Bright actions are those after which the goal is near.',
};

interface ChoiceProps {
  label: string;
  value: string;
  options: readonly (readonly [string, string])[];
  onChoose: (value: string) => void;
}

function Choice({ label, value, options, onChoose }: ChoiceProps) {
  return (
    <NativeSelect
      size="xs"
      aria-label={label}
      value={value}
      data={options.map(([option, text]) => ({ value: option, label: text }))}
      onChange={(event) => onChoose(event.currentTarget.value)}
    />
  );
}

/** Which demonstration is played, whose starts and goals are drawn, and what of it is shown. */
import { Badge, Button, NativeSelect, Switch } from '@mantine/core';
import { Icon } from '@/components/icon';
import type { Scene } from '@/lib/use-scene-control';
import type { About, InspectorState, Look } from './answers';
import classes from './inspector.module.css';

interface Props {
  scene: Scene;
  state: InspectorState;
  about: About;
}

const LOOK_NAMES: Record<Look, string> = {
  path: 'Path',
  fan: 'Fan',
  arrows: 'What it wants',
  surface: 'Q in the scene',
  grips: 'Move start and goal',
};

export function DemonstrationBar({ scene, state, about }: Props) {
  const { tell } = scene;
  const open = (number: number): void => tell({ do: 'open', seed: state.fan?.seed ?? state.seed, number });
  return (
    <section className={`card ${classes.bar}`} aria-label="Demonstration">
      <div className={classes.row}>
        <Button
          size="compact-sm"
          variant="default"
          disabled={state.number === 0}
          onClick={() => open(state.number - 1)}
        >
          Previous
        </Button>
        <Button
          size="compact-sm"
          variant="default"
          leftSection={<Icon name="arrow" size={13} />}
          onClick={() => open(state.number + 1)}
        >
          Next demonstration
        </Button>
        {about.start_tasks.length > 1 && (
          <NativeSelect
            size="xs"
            aria-label="Whose starts and goals"
            value={state.starts}
            data={about.start_tasks.map((task) => ({ value: task, label: `Starts of ${task}` }))}
            onChange={(event) => tell({ do: 'starts', task: event.currentTarget.value })}
          />
        )}
        {about.shapes.length > 0 && (
          <NativeSelect
            size="xs"
            aria-label="Shape of the goal"
            value=""
            data={[
              { value: '', label: 'Another shape …' },
              ...about.shapes.map((shape, at) => ({ value: String(at), label: shape })),
            ]}
            onChange={(event) => {
              if (event.currentTarget.value !== '') tell({ do: 'shape', shape: Number(event.currentTarget.value) });
            }}
          />
        )}
        <Told state={state} />
      </div>
      <div className={classes.row}>
        {(Object.keys(LOOK_NAMES) as Look[]).map((look) => (
          <Switch
            key={look}
            size="xs"
            label={LOOK_NAMES[look]}
            checked={state.looks[look]}
            disabled={look === 'grips' && !about.can_place}
            onChange={(event) => tell({ do: 'look', at: look, on: event.currentTarget.checked })}
          />
        ))}
      </div>
    </section>
  );
}

function Told({ state }: { state: InspectorState }) {
  const origins: Record<InspectorState['origin'], string> = {
    drawn: `number ${state.number} of seed ${state.seed}`,
    replayed: `number ${state.number} of seed ${state.seed}, made again from its start and actions`,
    placed: 'from where you put start or goal',
  };
  return (
    <span className={classes.told} role="status">
      <Badge size="sm" variant="light" color={state.reached ? 'teal' : 'orange'}>
        {state.reached ? 'reaches its goal' : 'misses its goal'}
      </Badge>{' '}
      <span className="faint">
        {origins[state.origin]}
        {state.exact === true && ': the same to the last bit'}
        {state.exact === false && ': not the same, this machine computes otherwise'}
      </span>
    </span>
  );
}

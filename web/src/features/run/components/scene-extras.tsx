/** What a kind of 3D view can do besides playing: the demonstration, the goal, the object, the epochs. */
import { Button, Checkbox, SegmentedControl } from '@mantine/core';
import { useState } from 'react';
import type { SceneState } from '@/lib/scene-control';
import type { Scene } from '@/lib/use-scene-control';
import type { GhostMode, RunSceneState } from '../scene-state';
import { EpochScrubber } from './epoch-scrubber';
import classes from './run.module.css';

/** How hard the button pushes an object [m/s]. */
const PUSH_SPEED = 0.8;

/** The colours of the arrows in the scene. */
const WANTED_COLOR = 'rgb(0 114 178)';
const INDUCED_COLOR = 'rgb(230 115 0)';

export function SceneExtras({ state, scene }: { state: SceneState; scene: Scene }) {
  const known: RunSceneState = state;
  const isLive = known.policies !== undefined;
  const isRecorded = !isLive && known.epochs === undefined;
  return (
    <section className={`card ${classes.extras}`} aria-label="In this view">
      <Reached reached={known.reached ?? []} />
      {known.epochs && <EpochScrubber state={known} tell={scene.tell} />}
      {isLive && <LiveControls state={known} tell={scene.tell} />}
      {known.ghost && <GhostControls state={known} tell={scene.tell} />}
      {isRecorded && <Resimulation scene={scene} />}
      {known.policies?.map(({ problem }) => problem && <span key={problem}>{problem}</span>)}
    </section>
  );
}

type Told = { state: RunSceneState; tell: Scene['tell'] };

function Reached({ reached }: { reached: readonly boolean[] }) {
  const count = reached.filter(Boolean).length;
  const text =
    reached.length === 1 ? (count ? 'at the goal' : 'not at the goal') : `${count} of ${reached.length} at the goal`;
  return <b>{text}</b>;
}

function LiveControls({ state, tell }: Told) {
  const push = (): void => {
    const way = 2 * Math.PI * Math.random();
    tell({ do: 'push', velocity: [PUSH_SPEED * Math.cos(way), PUSH_SPEED * Math.sin(way), 0] });
  };
  return (
    <span className={classes.extrasGroup}>
      <Button size="compact-sm" variant="default" onClick={() => tell({ do: 'new' })}>
        New goal
      </Button>
      <Button size="compact-sm" variant="default" onClick={push}>
        Push the object
      </Button>
      {state.reached?.length === 1 && (
        <Checkbox
          size="xs"
          label="Drag the goal in the scene"
          checked={state.gizmo ?? false}
          onChange={(event) => tell({ do: 'gizmo', on: event.currentTarget.checked })}
        />
      )}
    </span>
  );
}

function GhostControls({ state, tell }: Told) {
  const { ghost, arrows } = state;
  const show = (mode: GhostMode): void =>
    tell(mode === 'whole' ? { do: 'ghost', mode, from: state.step } : { do: 'ghost', mode });
  const isOn = arrows?.on ?? false;
  return (
    <span className={classes.extrasGroup}>
      Demonstration
      <SegmentedControl
        size="xs"
        aria-label="Demonstration"
        value={ghost?.mode ?? 'off'}
        onChange={(mode) => show(mode as GhostMode)}
        data={[
          { value: 'off', label: 'off' },
          { value: 'step', label: 'one step ahead' },
          { value: 'whole', label: ghost?.mode === 'whole' ? `whole, from step ${ghost.from}` : 'whole, from here' },
        ]}
      />
      {ghost?.mode === 'whole' && (
        <Button size="compact-xs" variant="default" onClick={() => show('whole')}>
          Begin here
        </Button>
      )}
      <Checkbox
        size="xs"
        checked={isOn}
        onChange={(event) => tell({ do: 'arrows', on: event.currentTarget.checked, turns: true })}
        label={
          <>
            <i className={classes.swatch} style={{ background: WANTED_COLOR }} />
            wanted (u) <i className={classes.swatch} style={{ background: INDUCED_COLOR }} />
            made to do (w)
          </>
        }
      />
      {isOn && (
        <Checkbox
          size="xs"
          label="axes of turning, thin"
          checked={arrows?.turns ?? false}
          onChange={(event) => tell({ do: 'arrows', on: true, turns: event.currentTarget.checked })}
        />
      )}
    </span>
  );
}

function Resimulation({ scene }: { scene: Scene }) {
  const [said, setSaid] = useState<string>();
  const check = async (): Promise<void> => {
    setSaid('simulating again ...');
    const answer = await scene.ask<{ equal: boolean; step: number | null }>({ do: 'resimulate' });
    setSaid(answer.equal ? 'the same to the last bit' : `differs from step ${answer.step} on`);
  };
  const fail = (error: Error): void => setSaid(error.message);
  return (
    <span className={classes.extrasGroup}>
      <Button size="compact-sm" variant="default" onClick={() => void check().catch(fail)}>
        Simulate again from its start and actions
      </Button>
      <output>{said}</output>
    </span>
  );
}

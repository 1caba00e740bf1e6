/** The time machine's scrubber: from the oldest policy to the newest, with how each did. */
import { Button } from '@mantine/core';
import type { SceneCommand } from '@/lib/scene-control';
import type { RunSceneState } from '../scene-state';
import classes from './run.module.css';

export function EpochScrubber({ state, tell }: { state: RunSceneState; tell: (command: SceneCommand) => void }) {
  const { epochs = [], at = 0, successes = [] } = state;
  const epoch = epochs[at] ?? '?';
  const success = successes[at];
  const outcome = success === null ? 'still being simulated' : success ? 'ends at the goal' : 'misses the goal';
  const reached = successes.filter(Boolean).length;
  return (
    <span className={classes.epochs}>
      <label htmlFor="epoch-scrubber">Policy of epoch</label>
      <input
        id="epoch-scrubber"
        type="range"
        min={0}
        max={epochs.length - 1}
        value={at}
        aria-valuetext={`epoch ${epoch}, ${outcome}`}
        onChange={(event) => tell({ do: 'epoch', at: Number(event.currentTarget.value) })}
      />
      <output className="number">
        <b>{epoch}</b> {outcome}
      </output>
      <span className="faint">
        {reached} of {epochs.length} policies end at the goal
      </span>
      <Button size="compact-sm" variant="default" onClick={() => tell({ do: 'new' })}>
        New start and goal
      </Button>
    </span>
  );
}

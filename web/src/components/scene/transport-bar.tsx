/** Play, pause, step, scrub, speed and loop: one bar for every 3D view; it drives the view and follows it. */
import { ActionIcon, NativeSelect, Tooltip } from '@mantine/core';
import { useEffect, useRef } from 'react';
import { Icon, type IconName } from '@/components/icon';
import type { SceneCommand, TransportState } from '@/lib/scene-control';
import classes from './scene.module.css';
import { KEYS_HELP, needsKey, readTransportKey } from './transport-keys';

/** Simulated seconds per second that can be chosen. */
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

/** Simulated time of one step [s]. */
const STEP_S = 0.04;

export function TransportBar({ state, tell }: { state: TransportState; tell: (command: SceneCommand) => void }) {
  useTransportKeys(state, tell);
  const { step, steps, playing, speed, loop } = state;
  return (
    <section className={`card ${classes.transport}`} aria-label="Transport" aria-description={KEYS_HELP}>
      <div className={classes.buttons}>
        <Press icon="toStart" label="First step (Home)" onPress={() => tell({ do: 'seek', step: 0 })} />
        <Press icon="stepBack" label="One step back (left arrow)" onPress={() => tell({ do: 'step', by: -1 })} />
        <Press
          icon={playing ? 'paused' : 'running'}
          label={playing ? 'Pause (space)' : 'Play (space)'}
          variant="filled"
          onPress={() => tell({ do: 'toggle' })}
        />
        <Press icon="stepOn" label="One step on (right arrow)" onPress={() => tell({ do: 'step', by: 1 })} />
        <Press icon="toEnd" label="Last step (End)" onPress={() => tell({ do: 'seek', step: steps })} />
      </div>
      <input
        type="range"
        className={classes.scrub}
        aria-label="Step"
        aria-valuetext={`step ${step} of ${steps}`}
        min={0}
        max={steps}
        value={step}
        onChange={(event) => tell({ do: 'seek', step: Number(event.currentTarget.value) })}
      />
      <output className={`number ${classes.clock}`} aria-label="Step shown">
        {step} / {steps} <span className="faint">{(step * STEP_S).toFixed(2)} s</span>
      </output>
      <div className={classes.pace}>
        <Press
          icon="retry"
          label="Loop"
          pressed={loop}
          variant={loop ? 'light' : 'subtle'}
          onPress={() => tell({ do: 'loop', on: !loop })}
        />
        <NativeSelect
          size="xs"
          aria-label="Speed"
          className={classes.speed}
          value={String(speed)}
          data={SPEEDS.map((value) => ({ value: String(value), label: `${value}×` }))}
          onChange={(event) => tell({ do: 'speed', speed: Number(event.currentTarget.value) })}
        />
      </div>
    </section>
  );
}

interface PressProps {
  icon: IconName;
  label: string;
  onPress: () => void;
  variant?: string;
  pressed?: boolean;
}

function Press({ icon, label, onPress, variant = 'subtle', pressed }: PressProps) {
  const color = variant === 'subtle' ? 'gray' : undefined;
  return (
    <Tooltip label={label} openDelay={400}>
      <ActionIcon variant={variant} color={color} size="md" onClick={onPress} aria-label={label} aria-pressed={pressed}>
        <Icon name={icon} size={16} />
      </ActionIcon>
    </Tooltip>
  );
}

/** Listen to the keys as long as the bar is there. */
function useTransportKeys(state: TransportState, tell: (command: SceneCommand) => void): void {
  const now = useRef({ state, tell });
  now.current = { state, tell };
  useEffect(() => {
    const press = (event: KeyboardEvent): void => {
      if (event.ctrlKey || event.metaKey || event.altKey || needsKey(event.target, event.key)) return;
      const command = readTransportKey(event.key, event.shiftKey, now.current.state);
      if (command === undefined) return;
      event.preventDefault();
      now.current.tell(command);
    };
    window.addEventListener('keydown', press);
    return () => window.removeEventListener('keydown', press);
  }, []);
}

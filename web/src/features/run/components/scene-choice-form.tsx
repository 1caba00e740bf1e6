/** Choose what of a run to show in 3D. */
import { Button, NativeSelect, SegmentedControl } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import type { RunDetail, RunFile } from '@/client/schema.gen';
import { Icon } from '@/components/icon';
import { besideQuery } from '../api/beside';
import { filesQuery } from '../api/run-records';
import {
  episodeCount,
  NEWEST,
  policyNames,
  recordedEpochs,
  SCENE_KINDS,
  SCENE_NAMES,
  SCENE_TEXTS,
  type SceneChoice,
  type SceneKind,
} from '../scene-choice';
import classes from './run.module.css';

interface Props {
  run: RunDetail;
  first: SceneChoice;
  onWatch: (choice: SceneChoice) => void;
}

export function SceneChoiceForm({ run, first, onWatch }: Props) {
  const [choice, setChoice] = useState(first);
  const { data } = useQuery(filesQuery(run.id));
  const files = data?.files ?? [];
  const epochs = recordedEpochs(files);
  const change = (changes: Partial<SceneChoice>): void => setChoice((old) => ({ ...old, ...changes }));
  const chosen = { ...choice, epoch: epochs.includes(choice.epoch) ? choice.epoch : (epochs[0] ?? choice.epoch) };
  const isMissing = choice.kind === 'episode' && epochs.length === 0;
  return (
    <section className={`card ${classes.choice}`} aria-label="What to show in 3D">
      <SegmentedControl
        aria-label="Kind of view"
        value={choice.kind}
        onChange={(kind) => change({ kind: kind as SceneKind })}
        data={SCENE_KINDS.map((value) => ({ value, label: SCENE_NAMES[value] }))}
      />
      <p className="faint">{SCENE_TEXTS[choice.kind]}</p>
      {choice.kind === 'live' && <LiveFields run={run} files={files} choice={choice} onChange={change} />}
      {choice.kind === 'episode' && <EpisodeFields run={run} epochs={epochs} choice={chosen} onChange={change} />}
      <Button disabled={isMissing} onClick={() => onWatch(chosen)} leftSection={<Icon name="cube" />}>
        {choice.kind === 'live' && choice.policy === NEWEST ? 'Watch the newest policy' : 'Watch'}
      </Button>
    </section>
  );
}

interface FieldsProps {
  choice: SceneChoice;
  onChange: (changes: Partial<SceneChoice>) => void;
}

function LiveFields({ run, files, choice, onChange }: FieldsProps & { run: RunDetail; files: readonly RunFile[] }) {
  const names = policyNames(files);
  const { data: others = [] } = useQuery(besideQuery(run));
  return (
    <div className={classes.choiceFields}>
      <NativeSelect
        label="Policy"
        value={choice.policy}
        onChange={(event) => onChange({ policy: event.currentTarget.value })}
        data={[{ value: NEWEST, label: 'newest, followed while it trains' }, ...names]}
      />
      <NativeSelect
        label="Beside it, from the same start"
        value={choice.beside}
        onChange={(event) => onChange({ beside: event.currentTarget.value })}
        data={[
          { value: '', label: 'nothing' },
          ...names.map((name) => ({ value: `${run.id}/${name}`, label: `this run, ${name}` })),
          ...others.map((other) => ({
            value: `${other.id}/${NEWEST}`,
            label: `${other.method}, seed ${other.seed}, run ${other.id.slice(0, 8)}`,
          })),
        ]}
      />
      <NativeSelect
        label="Episodes side by side"
        disabled={choice.beside !== ''}
        value={String(choice.episodes)}
        onChange={(event) => onChange({ episodes: Number(event.currentTarget.value) as 1 | 4 | 9 })}
        data={['1', '4', '9']}
      />
    </div>
  );
}

function EpisodeFields({ run, epochs, choice, onChange }: FieldsProps & { run: RunDetail; epochs: readonly number[] }) {
  if (epochs.length === 0) return <p>No test of this run has been recorded yet.</p>;
  return (
    <div className={classes.choiceFields}>
      <NativeSelect
        label="Test after epoch"
        value={String(choice.epoch)}
        onChange={(event) => onChange({ epoch: Number(event.currentTarget.value) })}
        data={epochs.map(String)}
      />
      <NativeSelect
        label="Episode"
        value={String(choice.index)}
        onChange={(event) => onChange({ index: Number(event.currentTarget.value) })}
        data={Array.from({ length: episodeCount(run.config, choice.index) }, (_, index) => String(index))}
      />
    </div>
  );
}

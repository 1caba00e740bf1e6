/** Which seeds to train, one run each: typed, or one of the usual choices. */
import { Chip, Group, TextInput } from '@mantine/core';
import { useTyped } from '@/lib/use-typed';
import classes from './launch.module.css';

const SEED_SHORTCUTS = ['0', '0-2', '0-4', '0-9'];

interface Props {
  seeds: string;
  problem: string | undefined;
  onChange: (seeds: string) => void;
}

export function SeedsField({ seeds, problem, onChange }: Props) {
  const { typed, type, send } = useTyped(seeds, onChange);
  const choose = (next: string): void => {
    type(next);
    send(next);
  };
  return (
    <div className={classes.seeds}>
      <TextInput
        label="Seeds"
        description="One run per seed: 0, or 0-4, or 1, 3, 7-9"
        w={280}
        value={typed}
        error={problem}
        onChange={(event) => choose(event.currentTarget.value)}
      />
      <Group gap={4} role="group" aria-label="Common seeds">
        {SEED_SHORTCUTS.map((shortcut) => (
          <Chip key={shortcut} size="xs" checked={typed.trim() === shortcut} onChange={() => choose(shortcut)}>
            {shortcut}
          </Chip>
        ))}
      </Group>
    </div>
  );
}

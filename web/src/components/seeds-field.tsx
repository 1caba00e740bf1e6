/** Which seeds to train: typed, or one of the usual choices. */
import { Chip, Group, TextInput } from '@mantine/core';
import { useTyped } from '@/lib/use-typed';
import classes from './seeds-field.module.css';

const SEED_SHORTCUTS = ['0', '0-2', '0-4', '0-9'];

interface Props {
  /** What to write, for this form. */
  description: string;
  seeds: string;
  problem: string | undefined;
  onChange: (seeds: string) => void;
}

export function SeedsField({ description, seeds, problem, onChange }: Props) {
  const { typed, type, send } = useTyped(seeds, onChange);
  const choose = (next: string): void => {
    type(next);
    send(next);
  };
  return (
    <div className={classes.seeds}>
      <TextInput
        label="Seeds"
        description={description}
        w={300}
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

/** The seeds of every cell. */
import { Chip, Group, TextInput } from '@mantine/core';
import classes from './builder.module.css';

const SHORTCUTS = ['0', '0-2', '0-4', '0-9'];

interface Props {
  seeds: string;
  problem: string | undefined;
  onChange: (seeds: string) => void;
}

export function SeedField({ seeds, problem, onChange }: Props) {
  return (
    <div className={classes.seeds}>
      <TextInput
        label="Seeds"
        description="0-4, or 1, 3, 7-9. Bands and intervals need three or more."
        w={300}
        value={seeds}
        error={problem}
        onChange={(event) => onChange(event.currentTarget.value)}
      />
      <Group gap={4} role="group" aria-label="Common seeds">
        {SHORTCUTS.map((text) => (
          <Chip key={text} size="xs" checked={seeds.trim() === text} onChange={() => onChange(text)}>
            {text}
          </Chip>
        ))}
      </Group>
    </div>
  );
}

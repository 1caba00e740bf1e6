/** Ask for a new token. */
import { Button, NativeSelect, TextInput } from '@mantine/core';
import { useState } from 'react';
import type { NewToken } from '@/client/schema.gen';
import { allows, ROLES, type Role } from '@/lib/access';

const LIVES = [
  { value: '7', label: '7 days' },
  { value: '90', label: '90 days' },
  { value: '365', label: 'a year' },
  { value: '', label: 'until it is revoked' },
];

interface Props {
  /** One's own role: no token may do more. */
  role: Role;
  isBusy: boolean;
  /** Make it; a promise that is broken if it is refused. */
  onCreate: (wish: NewToken) => Promise<unknown>;
}

export function TokenForm({ role, isBusy, onCreate }: Props) {
  const [name, setName] = useState('');
  const [chosen, setChosen] = useState<Role>('viewer');
  const [days, setDays] = useState('90');
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        // Why it was refused is told below; the name stays to be mended.
        onCreate({ name: name.trim(), role: chosen, days: days === '' ? null : Number(days) }).then(
          () => setName(''),
          () => undefined,
        );
      }}
    >
      <TextInput
        label="What it is for"
        placeholder="notebook on lab-3"
        maxLength={200}
        value={name}
        onChange={(event) => setName(event.currentTarget.value)}
        required
      />
      <NativeSelect
        label="Role"
        data={ROLES.filter((known) => allows(role, known.name)).map((known) => known.name)}
        value={chosen}
        onChange={(event) => setChosen(event.currentTarget.value as Role)}
      />
      <NativeSelect
        label="Valid for"
        data={LIVES}
        value={days}
        onChange={(event) => setDays(event.currentTarget.value)}
      />
      <Button type="submit" loading={isBusy} disabled={name.trim() === ''}>
        Make a token
      </Button>
    </form>
  );
}

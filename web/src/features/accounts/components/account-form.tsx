/** Make an account. */
import { Button, NativeSelect, TextInput } from '@mantine/core';
import { useState } from 'react';
import type { NewAccount } from '@/client/schema.gen';
import { ROLES, type Role } from '@/lib/access';

interface Props {
  isBusy: boolean;
  /** Make it; a promise that is broken if it is refused. */
  onAdd: (wish: NewAccount) => Promise<unknown>;
}

export function AccountForm({ isBusy, onAdd }: Props) {
  const [name, setName] = useState('');
  const [role, setRole] = useState<Role>('operator');
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        // Why it was refused is told below; the name stays to be mended.
        onAdd({ name, role }).then(
          () => setName(''),
          () => undefined,
        );
      }}
    >
      <TextInput
        label="Name of the new account"
        placeholder="ada"
        maxLength={64}
        pattern="[a-z0-9][a-z0-9._\-]*"
        title="Small letters, digits, points, dashes"
        value={name}
        onChange={(event) => setName(event.currentTarget.value.toLowerCase())}
        autoComplete="off"
        required
      />
      <NativeSelect
        label="Role"
        data={ROLES.map((known) => known.name)}
        value={role}
        onChange={(event) => setRole(event.currentTarget.value as Role)}
      />
      <Button type="submit" loading={isBusy} disabled={name === ''}>
        Add and make its link
      </Button>
    </form>
  );
}

/** Make an account. */
import { Button, NativeSelect, TextInput } from '@mantine/core';
import { useState } from 'react';
import type { NewAccount } from '@/client/schema.gen';
import { ROLES, type Role } from '@/lib/access';

export function AccountForm({ isBusy, onAdd }: { isBusy: boolean; onAdd: (wish: NewAccount) => void }) {
  const [name, setName] = useState('');
  const [role, setRole] = useState<Role>('operator');
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        onAdd({ name, role });
        setName('');
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

/** Every account: its role, whether it is open, and links for its owner. */
import { Button, NativeSelect } from '@mantine/core';
import { useMutation, useQuery, useQueryClient } from '@tanstack/react-query';
import type { AccountInfo, AccountUpdate, NewAccount } from '@/client/schema.gen';
import { CardSection } from '@/components/card-section';
import { NumberTable } from '@/components/number-table';
import { SecretOnce } from '@/components/secret-once';
import { ROLES, type Role } from '@/lib/access';
import { client, sentence, unwrap } from '@/lib/api';
import { formatMoment } from '@/lib/format';
import { AccountForm } from './account-form';

const KEY = ['accounts'];

export function AccountList() {
  const queries = useQueryClient();
  const refresh = () => queries.invalidateQueries({ queryKey: KEY });
  const { data, error } = useQuery({
    queryKey: KEY,
    queryFn: ({ signal }) => unwrap(client.GET('/api/accounts', { signal })),
  });
  const invite = useMutation({ mutationFn: makeLink, onSettled: refresh });
  const change = useMutation({
    mutationFn: ({ id, wish }: { id: string; wish: AccountUpdate }) =>
      unwrap(client.PATCH('/api/accounts/{account_id}', { params: { path: { account_id: id } }, body: wish })),
    onSettled: refresh,
  });
  const problem = invite.error ?? change.error ?? error;
  return (
    <CardSection title="Who may come in" note={ROLES.map(({ name, may }) => `${name}: ${may}`).join(' · ')}>
      {data && data.accounts.length > 0 && (
        <NumberTable
          name="Accounts"
          columns={['Name', 'Role', 'State', 'Made', '']}
          wordColumns={5}
          rows={data.accounts.map((account) => [
            account.name,
            <NativeSelect
              key="role"
              size="xs"
              aria-label={`Role of ${account.name}`}
              data={ROLES.map(({ name }) => name)}
              value={account.role}
              onChange={(event) => change.mutate({ id: account.id, wish: { role: event.currentTarget.value as Role } })}
            />,
            state(account),
            formatMoment(account.created_at),
            <Button.Group key="acts">
              <Button variant="default" size="compact-xs" onClick={() => invite.mutate(account.id)}>
                New link for {account.name}
              </Button>
              <Button
                variant="default"
                size="compact-xs"
                onClick={() => change.mutate({ id: account.id, wish: { disabled: account.disabled_at === null } })}
              >
                {account.disabled_at === null ? 'Close' : 'Open again'}
              </Button>
            </Button.Group>,
          ])}
        />
      )}
      {data?.accounts.length === 0 && <p className="faint">There is none yet.</p>}
      <AccountForm isBusy={invite.isPending} onAdd={(wish) => invite.mutateAsync(wish)} />
      {invite.data && (
        <SecretOnce
          label={`One-time link for ${invite.data.account.name}`}
          secret={window.location.origin + invite.data.path}
          note={`Hand it over in private. Whoever opens it sets the password; it ends ${formatMoment(invite.data.expires_at)}.`}
        />
      )}
      {problem && (
        <p className="problem" role="alert">
          {sentence(problem)}
        </p>
      )}
    </CardSection>
  );
}

/** A link for a new account, or for one that is there, by its id. */
function makeLink(wish: NewAccount | string) {
  if (typeof wish !== 'string') return unwrap(client.POST('/api/accounts', { body: wish }));
  return unwrap(client.POST('/api/accounts/{account_id}/invitation', { params: { path: { account_id: wish } } }));
}

function state(account: AccountInfo): string {
  if (account.disabled_at !== null) return `closed since ${formatMoment(account.disabled_at)}`;
  return account.has_password ? 'open' : 'waits for its link to be opened';
}

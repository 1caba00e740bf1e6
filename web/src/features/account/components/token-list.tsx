/** Tokens for programs: the list, and making one. */
import { Button } from '@mantine/core';
import { useMutation, useQuery, useQueryClient } from '@tanstack/react-query';
import type { NewToken } from '@/client/schema.gen';
import { CardSection } from '@/components/card-section';
import { NumberTable } from '@/components/number-table';
import { SecretOnce } from '@/components/secret-once';
import type { Role } from '@/lib/access';
import { client, sentence, unwrap } from '@/lib/api';
import { formatMoment } from '@/lib/format';
import { TokenForm } from './token-form';

const KEY = ['account', 'tokens'];

export function TokenList({ role }: { role: Role }) {
  const queries = useQueryClient();
  const refresh = () => queries.invalidateQueries({ queryKey: KEY });
  const { data, error } = useQuery({
    queryKey: KEY,
    queryFn: ({ signal }) => unwrap(client.GET('/api/account/tokens', { signal })),
  });
  const create = useMutation({
    mutationFn: (wish: NewToken) => unwrap(client.POST('/api/account/tokens', { body: wish })),
    onSettled: refresh,
  });
  const revoke = useMutation({
    mutationFn: async (id: string): Promise<void> => {
      const params = { path: { token_id: id } };
      await unwrap<unknown>(client.DELETE('/api/account/tokens/{token_id}', { params }));
    },
    onSettled: refresh,
  });
  const problem = create.error ?? revoke.error ?? error;
  return (
    <CardSection
      title="Tokens for programs"
      note={
        <>
          A program sends one as <code>Authorization: Bearer …</code>. It may do what its role says, and never more than
          you.
        </>
      }
    >
      {data && data.tokens.length > 0 && (
        <NumberTable
          name="Tokens"
          columns={['Name', 'Role', 'Made', 'Ends', 'Last used', '']}
          wordColumns={5}
          rows={data.tokens.map((token) => [
            token.name,
            token.role,
            formatMoment(token.created_at),
            token.expires_at ? formatMoment(token.expires_at) : 'when revoked',
            token.used_at ? formatMoment(token.used_at) : 'never',
            <Button
              key="revoke"
              variant="default"
              size="compact-xs"
              aria-label={`Revoke ${token.name}`}
              onClick={() => revoke.mutate(token.id)}
            >
              Revoke
            </Button>,
          ])}
        />
      )}
      <TokenForm role={role} isBusy={create.isPending} onCreate={(wish) => create.mutateAsync(wish)} />
      {create.data && (
        <SecretOnce
          label={`The token ${create.data.token.name}`}
          secret={create.data.secret}
          note="Copy it now: it is not kept, and shown this once."
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

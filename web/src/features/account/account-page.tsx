/** One's own account: who one is, where one is signed in, tokens for programs, the password. */
import { Button } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useNavigate } from '@tanstack/react-router';
import { ButtonLink } from '@/components/anchor-link';
import { CardSection } from '@/components/card-section';
import { SentencePanel } from '@/components/sentence-panel';
import { meQuery, ROLES, useSignOut } from '@/lib/access';
import { sentence } from '@/lib/api';
import { PasswordForm } from './components/password-form';
import { SessionList } from './components/session-list';
import { TokenList } from './components/token-list';

export function AccountPage() {
  const { data: me, error } = useQuery(meQuery);
  const navigate = useNavigate();
  const signOut = useSignOut();
  const caller = me?.caller;
  return (
    <>
      <title>Account · SLDR</title>
      <div className="page-head">
        <h1>Account</h1>
        {caller && (
          <Button
            variant="default"
            size="compact-sm"
            loading={signOut.isPending}
            onClick={() => signOut.mutate(undefined, { onSuccess: () => navigate({ to: '/sign-in' }) })}
          >
            Sign out
          </Button>
        )}
        {caller?.role === 'admin' && (
          <ButtonLink to="/accounts" variant="default" size="compact-sm">
            All accounts and audit log
          </ButtonLink>
        )}
      </div>
      {error && !me && (
        <SentencePanel urgent title="Your account cannot be shown">
          {sentence(error)}
        </SentencePanel>
      )}
      {caller && (
        <>
          <CardSection title={caller.name}>
            <span>
              Role: <b>{caller.role}</b>, who {ROLES.find(({ name }) => name === caller.role)?.may}.
            </span>
            {!caller.has_account && (
              <span className="faint">
                You came in with the token of this server, which listens to this machine only. Opened to others, it asks
                for accounts.
              </span>
            )}
          </CardSection>
          <SessionList />
          <TokenList role={caller.role} />
          {caller.has_account && <PasswordForm />}
        </>
      )}
    </>
  );
}

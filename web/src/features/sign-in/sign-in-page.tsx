/** Sign in: with an account, or with the token of a server on this machine. */
import { Button, PasswordInput, TextInput } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { getRouteApi, useRouter } from '@tanstack/react-router';
import { useState } from 'react';
import { ButtonLink } from '@/components/anchor-link';
import { EntryFrame } from '@/components/entry-frame';
import { type Entry, meQuery, useSignIn } from '@/lib/access';
import { sentence } from '@/lib/api';

const route = getRouteApi('/sign-in');

export function SignInPage() {
  const { from, reason } = route.useSearch();
  const router = useRouter();
  const { data: me, error } = useQuery(meQuery);
  const signIn = useSignIn();
  const enter = (entry: Entry): void => {
    signIn.mutate(entry, { onSuccess: () => router.history.push(from ?? '/') });
  };
  return (
    <EntryFrame title="Sign in">
      {reason === 'token' && (
        <p className="problem" role="alert">
          This address does not open the server any more; take the one that <code>sldr serve</code> prints.
        </p>
      )}
      {error && (
        <p className="problem" role="alert">
          {sentence(error)}
        </p>
      )}
      {me?.caller && (
        <>
          <p>You are signed in as {me.caller.name}.</p>
          <ButtonLink to="/">All runs</ButtonLink>
        </>
      )}
      {me && !me.caller && <p className="faint">{me.message}</p>}
      {me && !me.caller && me.mode === 'token' && <TokenForm onEnter={enter} isBusy={signIn.isPending} />}
      {me && !me.caller && me.mode === 'accounts' && <PasswordForm onEnter={enter} isBusy={signIn.isPending} />}
      {signIn.error && (
        <p className="problem" role="alert">
          {sentence(signIn.error)}
        </p>
      )}
    </EntryFrame>
  );
}

interface FormProps {
  onEnter: (entry: Entry) => void;
  isBusy: boolean;
}

function TokenForm({ onEnter, isBusy }: FormProps) {
  const [token, setToken] = useState('');
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        onEnter({ way: 'token', token: token.trim() });
      }}
    >
      <PasswordInput
        label="Token"
        description="It is the end of that address, and in the file access-token of the data directory."
        value={token}
        onChange={(event) => setToken(event.currentTarget.value)}
        autoComplete="off"
        required
        data-autofocus
      />
      <Button type="submit" loading={isBusy}>
        Sign in
      </Button>
    </form>
  );
}

function PasswordForm({ onEnter, isBusy }: FormProps) {
  const [name, setName] = useState('');
  const [password, setPassword] = useState('');
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        onEnter({ way: 'password', name: name.trim(), password });
      }}
    >
      <TextInput
        label="Name"
        value={name}
        onChange={(event) => setName(event.currentTarget.value)}
        autoComplete="username"
        autoCapitalize="none"
        required
      />
      <PasswordInput
        label="Password"
        value={password}
        onChange={(event) => setPassword(event.currentTarget.value)}
        autoComplete="current-password"
        required
      />
      <Button type="submit" loading={isBusy}>
        Sign in
      </Button>
      <p className="faint">No account, or the password forgotten? An admin makes a link with which you set one.</p>
    </form>
  );
}

/** Open a one-time link: set the password of an account, and be signed in. */
import { Button, PasswordInput } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useLocation, useNavigate } from '@tanstack/react-router';
import { useEffect, useState } from 'react';
import { ButtonLink } from '@/components/anchor-link';
import { EntryFrame } from '@/components/entry-frame';
import { useSignIn } from '@/lib/access';
import { client, sentence, unwrap } from '@/lib/api';

/** Characters of a password at least; the server has the last word. */
const SHORTEST_PASSWORD = 12;

export function WelcomePage() {
  const token = useToken();
  const invited = useQuery({
    queryKey: ['invitation', token],
    queryFn: () => unwrap(client.POST('/api/auth/invitation', { body: { token: token || 'none' } })),
    staleTime: Number.POSITIVE_INFINITY,
  });
  if (invited.error) {
    return (
      <EntryFrame title="This link opens nothing">
        <p role="alert">{sentence(invited.error)}</p>
        <ButtonLink to="/sign-in">Sign in</ButtonLink>
      </EntryFrame>
    );
  }
  return (
    <EntryFrame title={invited.data ? `Welcome, ${invited.data.name}` : 'Welcome'}>
      {invited.data && <SetPassword key={token} token={token} {...invited.data} />}
    </EntryFrame>
  );
}

/** The secret of the link that was opened last. */
function useToken(): string {
  const hash = useLocation({ select: (location) => location.hash });
  const navigate = useNavigate();
  const [token, setToken] = useState(hash);
  // The secret leaves the address, so that it stays neither in the history nor on the screen.
  useEffect(() => {
    if (hash === '') return;
    setToken(hash);
    void navigate({ to: '/welcome', replace: true });
  }, [hash, navigate]);
  return token;
}

function SetPassword({ token, name, role }: { token: string; name: string; role: string }) {
  const navigate = useNavigate();
  const signIn = useSignIn();
  const [password, setPassword] = useState('');
  const [again, setAgain] = useState('');
  const differ = again !== '' && again !== password;
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        if (!differ) signIn.mutate({ way: 'invitation', token, password }, { onSuccess: () => navigate({ to: '/' }) });
      }}
    >
      <p className="faint">Your role is {role}. Choose the password with which you sign in from now on.</p>
      <input type="text" name="username" autoComplete="username" value={name} readOnly hidden />
      <PasswordInput
        label="Password"
        description={`At least ${SHORTEST_PASSWORD} characters; several words are easy to keep in mind.`}
        minLength={SHORTEST_PASSWORD}
        value={password}
        onChange={(event) => setPassword(event.currentTarget.value)}
        autoComplete="new-password"
        required
      />
      <PasswordInput
        label="Once more"
        value={again}
        onChange={(event) => setAgain(event.currentTarget.value)}
        error={differ && 'It is not the same.'}
        autoComplete="new-password"
        required
      />
      <Button type="submit" loading={signIn.isPending}>
        Set it and sign in
      </Button>
      {signIn.error && (
        <p className="problem" role="alert">
          {sentence(signIn.error)}
        </p>
      )}
    </form>
  );
}

/** Replace one's password. */
import { Button, PasswordInput } from '@mantine/core';
import { useMutation } from '@tanstack/react-query';
import { useState } from 'react';
import { CardSection } from '@/components/card-section';
import { useToast } from '@/components/toasts';
import { client, sentence, unwrap } from '@/lib/api';

export function PasswordForm() {
  const toast = useToast();
  const [old, setOld] = useState('');
  const [next, setNext] = useState('');
  const change = useMutation({
    mutationFn: async (): Promise<void> => {
      await unwrap<unknown>(client.PUT('/api/account/password', { body: { old, new: next } }));
    },
    onSuccess: () => {
      setOld('');
      setNext('');
      toast({ text: 'Your password is changed; every other browser is signed out.' });
    },
  });
  return (
    <CardSection title="Password" note="At least 12 characters; several words are easy to keep in mind.">
      <form
        onSubmit={(event) => {
          event.preventDefault();
          change.mutate();
        }}
      >
        <PasswordInput
          label="Present password"
          w={220}
          value={old}
          onChange={(event) => setOld(event.currentTarget.value)}
          autoComplete="current-password"
          required
        />
        <PasswordInput
          label="New password"
          w={220}
          minLength={12}
          value={next}
          onChange={(event) => setNext(event.currentTarget.value)}
          autoComplete="new-password"
          required
        />
        <Button type="submit" loading={change.isPending}>
          Change it
        </Button>
      </form>
      {change.error && (
        <p className="problem" role="alert">
          {sentence(change.error)}
        </p>
      )}
    </CardSection>
  );
}

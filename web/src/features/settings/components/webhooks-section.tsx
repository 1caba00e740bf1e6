/** The services that are told when a study ends or a run fails. */
import { Button, Checkbox, TextInput } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { type FormEvent, useState } from 'react';
import type { AddedWebhook, NewWebhook } from '@/client/schema.gen';
import { CopyButton } from '@/components/copy-button';
import { sentence } from '@/lib/api';
import { useAddWebhook, webhooksQuery } from '../api/webhooks';
import classes from './settings.module.css';
import { WebhookItem } from './webhook-item';

export function WebhooksSection() {
  const { data, error } = useQuery(webhooksQuery);
  const [added, setAdded] = useState<AddedWebhook>();
  return (
    <section className={`card ${classes.section}`} aria-labelledby="webhooks">
      <h2 id="webhooks">Webhooks</h2>
      <p className="faint">
        A signed JSON message is sent to each address. Chats such as Mattermost or Slack show its text as it is.
      </p>
      <AddForm onAdded={setAdded} />
      {added && <Secret webhook={added} />}
      {error && !data && <p className="problem">{sentence(error)}</p>}
      {data && data.webhooks.length > 0 && (
        <ul className={classes.webhooks} aria-label="Webhooks">
          {data.webhooks.map((webhook) => (
            <WebhookItem key={webhook.id} webhook={webhook} />
          ))}
        </ul>
      )}
    </section>
  );
}

const EVENTS = [
  { event: 'study_ended', label: 'A study has ended' },
  { event: 'run_failed', label: 'A run has failed' },
] as const;

function AddForm({ onAdded }: { onAdded: (webhook: AddedWebhook) => void }) {
  const adding = useAddWebhook();
  const [url, setUrl] = useState('');
  const [events, setEvents] = useState<NewWebhook['events']>(['study_ended', 'run_failed']);
  const add = (event: FormEvent): void => {
    event.preventDefault();
    adding.mutate(
      { url: url.trim(), events },
      {
        onSuccess: (webhook) => {
          onAdded(webhook);
          setUrl('');
        },
      },
    );
  };
  return (
    <form className={classes.row} aria-label="Add a webhook" onSubmit={add}>
      <TextInput
        className={classes.grow}
        label="Address"
        placeholder="https://chat.example.org/hooks/abc"
        value={url}
        error={adding.error ? sentence(adding.error) : undefined}
        onChange={(event) => setUrl(event.currentTarget.value)}
      />
      {EVENTS.map(({ event, label }) => (
        <Checkbox
          key={event}
          label={label}
          checked={events.includes(event)}
          onChange={({ currentTarget: { checked } }) =>
            setEvents((others) => (checked ? [...others, event] : others.filter((other) => other !== event)))
          }
        />
      ))}
      <Button type="submit" loading={adding.isPending} disabled={url.trim() === '' || events.length === 0}>
        Add
      </Button>
    </form>
  );
}

function Secret({ webhook }: { webhook: AddedWebhook }) {
  return (
    <div className={classes.secret} role="status">
      <span>Messages are signed with this secret. It is shown only now:</span>
      <code>{webhook.secret}</code>
      <span>
        <CopyButton text={webhook.secret} label="Copy the secret" />
      </span>
    </div>
  );
}

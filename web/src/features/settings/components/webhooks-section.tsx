/** The services that are told when a study ends or a run fails. */
import { Button, Checkbox, TextInput } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { type FormEvent, useState } from 'react';
import type { AddedWebhook, NewWebhook } from '@/client/schema.gen';
import { CardSection } from '@/components/card-section';
import { SecretOnce } from '@/components/secret-once';
import { allows, type Role } from '@/lib/access';
import { sentence } from '@/lib/api';
import { useAddWebhook, webhooksQuery } from '../api/webhooks';
import classes from './settings.module.css';
import { WebhookItem } from './webhook-item';

export function WebhooksSection({ role }: { role: Role }) {
  const mayChange = allows(role, 'admin');
  const { data, error } = useQuery({ ...webhooksQuery, enabled: allows(role, 'operator') });
  const [added, setAdded] = useState<AddedWebhook>();
  return (
    <CardSection
      title="Webhooks"
      note="A signed JSON message is sent to each address. Chats such as Mattermost or Slack show its text as it is."
    >
      {mayChange ? <AddForm onAdded={setAdded} /> : <p className="faint">Only an admin may change them.</p>}
      {added && (
        <SecretOnce
          label={`Messages to ${added.url} are signed with this secret:`}
          secret={added.secret}
          note="It is shown only now."
        />
      )}
      {error && !data && <p className="problem">{sentence(error)}</p>}
      {data && data.webhooks.length > 0 && (
        <ul className={classes.webhooks} aria-label="Webhooks">
          {data.webhooks.map((webhook) => (
            <WebhookItem key={webhook.id} webhook={webhook} mayChange={mayChange} />
          ))}
        </ul>
      )}
    </CardSection>
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
      <div className={classes.events}>
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
      </div>
      <Button type="submit" loading={adding.isPending} disabled={url.trim() === '' || events.length === 0}>
        Add
      </Button>
    </form>
  );
}

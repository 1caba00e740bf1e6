/** One address that is told, and what became of the newest messages to it. */
import { Button } from '@mantine/core';
import type { Delivery, Webhook } from '@/client/schema.gen';
import { useComplaint } from '@/components/toasts';
import { formatMoment, formatPlural } from '@/lib/format';
import { useRemoveWebhook, useTestWebhook } from '../api/webhooks';
import classes from './settings.module.css';

/** Messages shown of one address. */
const SHOWN = 5;

const EVENT_WORDS = { study_ended: 'a study has ended', run_failed: 'a run has failed', test: 'test' } as const;

export function WebhookItem({ webhook, mayChange }: { webhook: Webhook; mayChange: boolean }) {
  const told = webhook.events.map((event) => EVENT_WORDS[event as keyof typeof EVENT_WORDS] ?? event);
  return (
    <li className={classes.webhook}>
      <span className={`mono ${classes.url}`}>{webhook.url}</span>
      <span className="faint">Told when {told.join(' or ')}.</span>
      {mayChange && <Changes webhook={webhook} />}
      {webhook.deliveries.length > 0 && (
        <ul aria-label={`Messages to ${webhook.url}`}>
          {webhook.deliveries.slice(0, SHOWN).map((delivery) => (
            <li key={delivery.id}>{standing(delivery)}</li>
          ))}
        </ul>
      )}
    </li>
  );
}

function Changes({ webhook }: { webhook: Webhook }) {
  const complain = useComplaint();
  const removing = useRemoveWebhook();
  const testing = useTestWebhook();
  return (
    <span className={classes.row}>
      <Button
        size="xs"
        variant="light"
        loading={testing.isPending}
        aria-label={`Send a test to ${webhook.url}`}
        onClick={() => testing.mutate(webhook.id, { onError: complain })}
      >
        Send a test
      </Button>
      <Button
        size="xs"
        variant="default"
        loading={removing.isPending}
        aria-label={`Remove ${webhook.url}`}
        onClick={() => removing.mutate(webhook.id, { onError: complain })}
      >
        Remove
      </Button>
    </span>
  );
}

function standing({ event, state, tries, problem, created_at, next_try_at }: Delivery): string {
  const what = `${formatMoment(created_at)}, ${EVENT_WORDS[event]}: `;
  if (state === 'sent') return `${what}sent`;
  if (state === 'failed')
    return `${what}given up after ${formatPlural(tries, 'try').replace('trys', 'tries')}. ${problem}`;
  return problem ? `${what}tried again ${formatMoment(next_try_at)}. ${problem}` : `${what}on its way`;
}

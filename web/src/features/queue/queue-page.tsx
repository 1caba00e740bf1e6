/** What trains, what waits, in which order and for what. */
import { Button } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import type { QueueEntry } from '@/client/schema.gen';
import { ButtonLink } from '@/components/anchor-link';
import { Freshness } from '@/components/freshness';
import { OnlyFor } from '@/components/only-for';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatPlural, formatUntil } from '@/lib/format';
import { useNow } from '@/lib/use-now';
import { queueQuery } from './api/get-queue';
import { QueueList } from './components/queue-list';
import { endOf } from './order';

/** Rows shown at first, and added by each click. */
const STEP = 200;

/** As many as one answer holds. */
const MOST = 1000;

export function QueuePage() {
  const [limit, setLimit] = useState(STEP);
  const { data, error, dataUpdatedAt, isPlaceholderData } = useQuery(queueQuery(limit));
  const hidden = data ? data.total - data.entries.length : 0;
  return (
    <>
      <title>Queue · SLDR</title>
      <div className="page-head">
        <h1>Queue</h1>
        {data && data.entries.length > 0 && <Summary entries={data.entries} total={data.total} />}
        <Freshness updatedAt={dataUpdatedAt} />
      </div>
      {error && !data && (
        <SentencePanel urgent title="The queue cannot be shown">
          {sentence(error)}
        </SentencePanel>
      )}
      {data?.entries.length === 0 && (
        <SentencePanel
          title="Nothing runs and nothing waits"
          actions={
            <OnlyFor least="operator">
              <ButtonLink to="/launch">New run</ButtonLink>
            </OnlyFor>
          }
        >
          Launched runs stand here until they have ended, in the order in which they start.
        </SentencePanel>
      )}
      {data && data.entries.length > 0 && <QueueList queue={{ entries: data.entries, isWhole: hidden === 0 }} />}
      {hidden > 0 && (
        <p className="faint">
          {formatPlural(hidden, 'run')} more.{' '}
          {limit < MOST && (
            <Button
              variant="default"
              size="compact-sm"
              loading={isPlaceholderData}
              onClick={() => setLimit(Math.min(MOST, limit + STEP))}
            >
              Show more
            </Button>
          )}
        </p>
      )}
    </>
  );
}

function Summary({ entries, total }: { entries: readonly QueueEntry[]; total: number }) {
  const now = useNow();
  const running = entries.filter(({ run }) => run.state === 'running').length;
  const end = entries.length === total ? endOf(entries) : null;
  return (
    <span className="faint number">
      {running} running · {total - running} waiting
      {end !== null && ` · all done ${formatUntil((end - now) / 1000)}`}
    </span>
  );
}

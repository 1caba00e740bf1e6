/** What trains, what waits, in which order and for what. */
import { useQuery } from '@tanstack/react-query';
import type { QueueEntry } from '@/client/schema.gen';
import { ButtonLink } from '@/components/anchor-link';
import { Freshness } from '@/components/freshness';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatUntil } from '@/lib/format';
import { useNow } from '@/lib/use-now';
import { queueQuery } from './api/get-queue';
import { QueueList } from './components/queue-list';
import { endOf } from './order';

export function QueuePage() {
  const { data, error, dataUpdatedAt } = useQuery(queueQuery);
  return (
    <>
      <title>Queue · SLDR</title>
      <div className="page-head">
        <h1>Queue</h1>
        {data && data.entries.length > 0 && <Summary entries={data.entries} />}
        <Freshness updatedAt={dataUpdatedAt} />
      </div>
      {error && !data && (
        <SentencePanel urgent title="The queue cannot be shown">
          {sentence(error)}
        </SentencePanel>
      )}
      {data?.entries.length === 0 && (
        <SentencePanel title="Nothing runs and nothing waits" actions={<ButtonLink to="/launch">New run</ButtonLink>}>
          Launched runs stand here until they have ended, in the order in which they start.
        </SentencePanel>
      )}
      {data && data.entries.length > 0 && <QueueList entries={data.entries} />}
    </>
  );
}

function Summary({ entries }: { entries: readonly QueueEntry[] }) {
  const now = useNow();
  const running = entries.filter(({ run }) => run.state === 'running').length;
  const end = endOf(entries);
  return (
    <span className="faint number">
      {running} running · {entries.length - running} waiting
      {end !== null && ` · all done ${formatUntil((end - now) / 1000)}`}
    </span>
  );
}

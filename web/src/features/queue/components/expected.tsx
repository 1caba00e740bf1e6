/** When a run starts and ends, as far as anybody can say. */
import type { QueueEntry } from '@/client/schema.gen';
import { formatAgo, formatMoment, formatUntil, NOTHING, secondsBetween } from '@/lib/format';
import { useNow } from '@/lib/use-now';
import classes from './queue.module.css';

const UNKNOWN = 'Nobody can say: it waits for a person, or no run of its kind has succeeded yet.';

export function Expected({ entry: { run, starts_at, ends_at } }: { entry: QueueEntry }) {
  const now = useNow();
  const ago = formatAgo(secondsBetween(starts_at, now));
  const until = (moment: string): string => formatUntil((Date.parse(moment) - now) / 1000);
  return (
    <dl className={classes.expected}>
      <div>
        <dt className="faint">{run.state === 'running' ? 'Started' : 'Starts'}</dt>
        <dd className="number" title={starts_at ? formatMoment(starts_at) : UNKNOWN}>
          {starts_at === null ? NOTHING : run.state === 'running' ? ago : until(starts_at)}
        </dd>
      </div>
      <div>
        <dt className="faint">Ends</dt>
        <dd className="number" title={ends_at ? formatMoment(ends_at) : UNKNOWN}>
          {ends_at === null ? NOTHING : until(ends_at)}
        </dd>
      </div>
    </dl>
  );
}

/** How old the data on the page is. */
import { formatAgo } from '@/lib/format';
import { useBrowserNow } from '@/lib/use-now';

/** Beyond this, data counts as stale [ms]. */
const STALE_AFTER_MS = 8_000;

export function Freshness({ updatedAt }: { updatedAt: number }) {
  const now = useBrowserNow();
  if (updatedAt === 0) return null;
  const age = Math.max(0, now - updatedAt);
  const isStale = age > STALE_AFTER_MS;
  return (
    <span className="freshness" data-stale={isStale || undefined} aria-live="off">
      <span className="freshness-dot" aria-hidden="true" />
      {isStale ? 'stale, ' : ''}updated {formatAgo(age / 1000)}
    </span>
  );
}

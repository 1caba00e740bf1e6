/** Say so when the server does not answer, or when nobody is there to train. */
import { useQuery } from '@tanstack/react-query';
import { Icon } from '@/components/icon';
import { Unreachable } from '@/lib/api';
import { formatAgo } from '@/lib/format';
import { healthQuery } from '@/lib/queries';
import { useBrowserNow } from '@/lib/use-now';
import classes from './shell.module.css';

export function ConnectionBanner() {
  const { data, error, dataUpdatedAt } = useQuery(healthQuery);
  if (error instanceof Unreachable) return <Reconnecting since={dataUpdatedAt} />;
  if (error) return <Banner>{error.message}</Banner>;
  if (data && data.workers_alive === 0) {
    return (
      <Banner>
        No worker is alive, so queued runs wait. Start one with <code>sldr worker</code>.
      </Banner>
    );
  }
  return null;
}

function Reconnecting({ since }: { since: number }) {
  const now = useBrowserNow();
  return (
    <Banner>
      Reconnecting: the server does not answer. Is <code>sldr serve</code> running?
      {/* It counts, and would be read out each second. */}
      {since > 0 && <span aria-hidden> What you see was last confirmed {formatAgo((now - since) / 1000)}.</span>}
    </Banner>
  );
}

function Banner({ children }: { children: React.ReactNode }) {
  return (
    <div className={classes.banner} role="status">
      <Icon name="failed" size={15} />
      <span>{children}</span>
    </div>
  );
}

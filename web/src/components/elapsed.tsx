/** How long a run has been trained; pauses and waits do not count. */
import type { RunSummary } from '@/client/schema.gen';
import { formatDuration, NOTHING, secondsBetween } from '@/lib/format';
import { useNow } from '@/lib/use-now';

type Trained = Pick<RunSummary, 'started_at' | 'trained_s' | 'training_since'>;

export function Elapsed({ run }: { run: Trained }) {
  if (run.training_since !== null) return <Running since={run.training_since} before={run.trained_s} />;
  return <>{run.started_at === null ? NOTHING : formatDuration(run.trained_s)}</>;
}

function Running({ since, before }: { since: string; before: number }) {
  const now = useNow();
  return <>{formatDuration(before + (secondsBetween(since, now) ?? 0))}</>;
}

/** What launching a study would do and cost, asked again whenever a form rests. */
import { keepPreviousData, queryOptions } from '@tanstack/react-query';
import type { StudyPreview, StudySpec } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';
import { formatDuration, formatPlural, formatSize } from '@/lib/format';

/** What can be reused changes as runs come and go [ms]. */
const RENEW_MS = 10_000;

export function previewQuery(spec: StudySpec | null, studyId: string | null = null) {
  return queryOptions({
    queryKey: ['study-preview', spec, studyId],
    queryFn: ({ signal }) =>
      unwrap(client.POST('/api/studies/preview', { body: { spec: spec as StudySpec, study_id: studyId }, signal })),
    enabled: spec !== null,
    placeholderData: keepPreviousData,
    refetchInterval: RENEW_MS,
  });
}

/** How long the new runs take, in one sentence. */
export function describeTime({ estimate, queued }: StudyPreview): string {
  if (queued === 0) return 'Nothing has to be trained.';
  if (estimate.training_s === null)
    return `Nobody knows yet how long ${formatPlural(estimate.unknown_runs, 'run')} will take: nothing like them has succeeded here.`;
  const training = `About ${formatDuration(estimate.training_s)} of training`;
  if (estimate.until_done_s === null) return `${training}; no worker is alive that would take the runs.`;
  return `${training}, done in about ${formatDuration(estimate.until_done_s)} on ${formatPlural(estimate.slots, 'slot')} once it begins.`;
}

/** What the new runs take of the disk, in one sentence. */
export function describeDisk({ estimate }: StudyPreview): string {
  return `${formatSize(estimate.disk_bytes)} of disk, mostly for what is remembered; ${formatSize(estimate.disk_free_bytes)} are free here.`;
}

/** Whether the new runs would fill the disk. */
export function isTooLarge({ estimate }: StudyPreview): boolean {
  return estimate.disk_bytes > estimate.disk_free_bytes;
}

/** How many places come to their run in each way. */
export function countStandings(
  places: StudyPreview['places'],
): Record<StudyPreview['places'][number]['standing'], number> {
  const counts = { new: 0, joined: 0, in_study: 0 };
  for (const { standing } of places) counts[standing] += 1;
  return counts;
}

/** What launching a study would queue, reuse and cost, in a few sentences. */
import type { StudyPreview } from '@/client/schema.gen';
import { formatPlural } from '@/lib/format';
import { countStandings, describeDisk, describeTime, isTooLarge } from '@/lib/study-preview';
import classes from './preview-sums.module.css';

export function PreviewSums({ preview }: { preview: StudyPreview }) {
  const { new: made, joined, in_study: there } = countStandings(preview.places);
  const reused = preview.locomotion.filter((run) => run.run_id !== null).length;
  const shelved = preview.locomotion.filter((run) => run.run_id === null && run.zoo_success !== null).length;
  const added = preview.locomotion.length - reused - shelved;
  return (
    <ul className={classes.sums}>
      <li>
        <b>{formatPlural(preview.queued, 'run')}</b> will be queued
        {joined > 0 && <>, {formatPlural(joined, 'run')} from elsewhere reused</>}
        {there > 0 && <>, {formatPlural(there, 'run')} there already</>}.
      </li>
      {preview.locomotion.length > 0 && (
        <li>
          Locomotion:{' '}
          {[shelved > 0 && `${shelved} from the zoo`, reused > 0 && `${reused} reused`, added > 0 && `${added} added`]
            .filter(Boolean)
            .join(', ')}
          {made > 0 && added > 0 && ', trained first'}.
        </li>
      )}
      <li>{describeTime(preview)}</li>
      {preview.queued > 0 && (
        <li data-problem={isTooLarge(preview) || undefined}>
          {describeDisk(preview)}
          {isTooLarge(preview) && ' That is too much: choose less, or a lower replay.capacity.'}
        </li>
      )}
    </ul>
  );
}

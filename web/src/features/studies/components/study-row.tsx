/** One study of the list: what it compares and how far it is. */
import { Button } from '@mantine/core';
import type { StudySummary } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { ShareBar } from '@/components/share-bar';
import { StateCounts } from '@/components/state-counts';
import { useComplaint } from '@/components/toasts';
import { useMay } from '@/lib/access';
import { formatMoment, formatPlural, formatShare } from '@/lib/format';
import { describeAxes, leadingState } from '@/lib/studies';
import { useStudyAction } from '@/lib/use-study-action';
import classes from './studies.module.css';

export function StudyRow({ study }: { study: StudySummary }) {
  const complain = useComplaint();
  const restoring = useStudyAction();
  const isMine = useMay('operator');
  const restore = (): void => restoring.mutate({ action: 'restore', studyId: study.id }, { onError: complain });
  return (
    <li className={`card ${classes.study}`} data-study={study.id}>
      <div className={classes.words}>
        <AnchorLink to="/studies/$studyId" params={{ studyId: study.id }} fw={600}>
          {study.name}
        </AnchorLink>
        <span className="faint">
          {describeAxes(study.spec)} · preset {study.spec.preset}
        </span>
        {study.note && <span className={classes.note}>{study.note}</span>}
      </div>
      <div className={classes.state}>
        <span className={classes.progress}>
          <ShareBar share={study.progress} state={leadingState(study.states)} label={`Progress of ${study.name}`} />
          <span className="number">{formatShare(study.progress)}</span>
        </span>
        <StateCounts states={study.states} />
        <span className="faint number">
          {formatPlural(study.size, 'run')} · {formatMoment(study.created_at)}
        </span>
        {study.deleted_at !== null && isMine && (
          <Button variant="default" size="compact-xs" loading={restoring.isPending} onClick={restore}>
            Restore
          </Button>
        )}
      </div>
    </li>
  );
}

/** Which study this is, how it stands, and what can be done with it. */
import type { StudyDetail } from '@/client/schema.gen';
import { Freshness } from '@/components/freshness';
import { ShareBar } from '@/components/share-bar';
import { StateCounts } from '@/components/state-counts';
import { formatMoment, formatShare } from '@/lib/format';
import { describeAxes, leadingState } from '@/lib/studies';
import classes from './study.module.css';
import { StudyActions } from './study-actions';

export function StudyHeader({ study, updatedAt }: { study: StudyDetail; updatedAt: number }) {
  const changed = Object.entries(study.spec.overrides ?? {}).flatMap(([group, values]) =>
    Object.entries(Object(values)).map(([name, value]) => `${group}.${name} = ${JSON.stringify(value)}`),
  );
  return (
    <header>
      <div className="page-head">
        <h1>{study.name}</h1>
        <Freshness updatedAt={updatedAt} />
        <StudyActions study={study} />
      </div>
      {study.deleted_at !== null && (
        <p className={classes.deleted} role="status">
          This study was deleted {formatMoment(study.deleted_at)}. Its runs are as they were; restore it to change it
          again.
        </p>
      )}
      <p className={`faint ${classes.axes}`}>
        {describeAxes(study.spec)} · preset {study.spec.preset}
        {changed.length > 0 && ` · ${changed.join(' · ')}`}
      </p>
      {study.note && <p className={classes.note}>{study.note}</p>}
      <div className={classes.sum}>
        <span className={classes.sumBar}>
          <ShareBar share={study.progress} state={leadingState(study.states)} label="Progress of the study" />
        </span>
        <span className="number">{formatShare(study.progress)} trained</span>
        <StateCounts states={study.states} />
      </div>
    </header>
  );
}

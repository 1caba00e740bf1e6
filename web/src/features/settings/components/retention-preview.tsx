/** What a rule would remove, run by run. */
import type { RetentionPreview } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { formatMoment, formatPlural, formatSize } from '@/lib/format';
import { KINDS } from '../kinds';
import classes from './settings.module.css';

/** Runs shown, those with the largest share. */
const SHOWN = 10;

export function RetentionPreviewTable({ preview, days }: { preview: RetentionPreview; days: number }) {
  const { kinds, runs, total_runs, size, spared_young, spared_kept, spared_needed } = preview;
  const spared = [
    `${spared_young} ended less than ${formatPlural(days, 'day')} ago`,
    `${spared_kept} tagged to be kept`,
    `${spared_needed} that others learn from`,
  ].join(', ');
  return (
    <div aria-live="polite">
      <p>
        <b>{total_runs === 0 ? 'Nothing would be removed.' : `${formatSize(size)} would be removed`}</b>
        {total_runs > 0 && ` of ${formatPlural(total_runs, 'run')}: `}
        {kinds
          .filter(({ files }) => files > 0)
          .map((sum) => `${labelOf(sum.kind)} ${formatSize(sum.size)}`)
          .join(', ')}
      </p>
      <p className="faint">Spared: {spared}.</p>
      {runs.length > 0 && (
        <div className={classes.scroll}>
          <table className={classes.table}>
            <thead>
              <tr>
                <th scope="col">Run</th>
                <th scope="col">Ended</th>
                <th scope="col">Files</th>
                <th scope="col">Size</th>
              </tr>
            </thead>
            <tbody>
              {runs.slice(0, SHOWN).map((run) => (
                <tr key={run.run_id}>
                  <td>
                    <AnchorLink to="/runs/$runId" params={{ runId: run.run_id }} fz="inherit">
                      {run.task} {run.phase}, {run.method}, seed {run.seed}
                    </AnchorLink>
                  </td>
                  <td className="number">{formatMoment(run.ended_at)}</td>
                  <td className="number">{run.files}</td>
                  <td className="number">{formatSize(run.size)}</td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
      {total_runs > SHOWN && <p className="faint">and {formatPlural(total_runs - SHOWN, 'more run')}</p>}
    </div>
  );
}

function labelOf(kind: string): string {
  return KINDS.find((known) => known.kind === kind)?.label.toLowerCase() ?? kind;
}

/** Which runs were asked for and are not shown, and why: nothing is left out in silence. */

import type { LeftOut } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { formatPlural } from '@/lib/format';
import classes from './controls.module.css';

interface Props {
  comparison: { readonly unread: number; readonly every?: number; readonly left_out: readonly LeftOut[] };
}

export function LeftOutNotes({ comparison: { unread, every = 1, left_out } }: Props) {
  return (
    <div className={classes.notes}>
      {unread > 0 && (
        <p>{formatPlural(unread, 'older run')} would fit too; only the newest are read. Filter for them.</p>
      )}
      {every > 1 && <p>This metric has so many points that only one cycle in {every} is read.</p>}
      {left_out.length > 0 && (
        <details>
          <summary>{formatPlural(left_out.length, 'run')} not shown</summary>
          <ul>
            {left_out.map(({ run_id, task, group, seed, reason }) => (
              <li key={run_id}>
                <AnchorLink to="/runs/$runId" params={{ runId: run_id }} fz={12.5}>
                  {task}, {group}, seed {seed}
                </AnchorLink>
                : {reason}
              </li>
            ))}
          </ul>
        </details>
      )}
    </div>
  );
}

/** One number a method over all tasks: a point, and how sure it is. */
import type { Group, OverallScore } from '@/client/schema.gen';
import { LineSwatch } from '@/components/line-swatch';
import { formatShare } from '@/lib/format';
import { groupStyle, type Scheme } from '@/lib/palette';
import classes from './best.module.css';

interface Props {
  overall: readonly OverallScore[];
  groups: readonly Group[];
  scheme: Scheme;
}

export function OverallBars({ overall, groups, scheme }: Props) {
  const ranked = [...overall].sort((one, other) => (other.iqm ?? -1) - (one.iqm ?? -1));
  return (
    <ul className={classes.overall}>
      {ranked.map(({ group: key, iqm, low, high, n }) => {
        const group = groups.find((other) => other.key === key);
        if (group === undefined || iqm === null) return null;
        const style = groupStyle(group, scheme);
        return (
          <li key={key}>
            <span className={classes.name}>
              <LineSwatch style={style} />
              {group.label}
            </span>
            <span className={classes.scale} aria-hidden="true">
              {low !== null && high !== null && (
                <span
                  className={classes.interval}
                  style={{ left: `${100 * low}%`, width: `${100 * (high - low)}%`, background: style.color }}
                />
              )}
              <span className={classes.dot} style={{ left: `${100 * iqm}%`, background: style.color }} />
            </span>
            <span className="number">
              <b>{formatShare(iqm, 1)}</b>{' '}
              <span className="faint">
                {low === null || high === null ? '' : `${formatShare(low, 1)} to ${formatShare(high, 1)}, `}n {n}
              </span>
            </span>
          </li>
        );
      })}
    </ul>
  );
}

/** The methods and how they look; pointing at one makes it stand out everywhere, a click keeps it so. */
import type { Group } from '@/client/schema.gen';
import { LineSwatch } from '@/components/line-swatch';
import type { Emphasis } from '@/lib/curves';
import { groupStyle, type Scheme } from '@/lib/palette';
import classes from './panels.module.css';

interface Props {
  groups: readonly Group[];
  scheme: Scheme;
  emphasis: Emphasis | null;
  pin: string | undefined;
  /** What line and band are, in words. */
  statistic: string;
  onNear: (emphasis: Emphasis | null) => void;
  onPick: (emphasis: Emphasis) => void;
}

export function GroupLegend({ groups, scheme, emphasis, pin, statistic, onNear, onPick }: Props) {
  return (
    <div className={classes.legend} role="toolbar" aria-label="Methods">
      {groups.map((group) => (
        <button
          key={group.key}
          type="button"
          className={classes.key}
          aria-pressed={pin === group.key}
          title={pin === group.key ? 'Let it go' : 'Keep it standing out'}
          data-faded={(emphasis !== null && emphasis.key !== group.key) || undefined}
          onMouseEnter={() => onNear({ key: group.key })}
          onMouseLeave={() => onNear(null)}
          onFocus={() => onNear({ key: group.key })}
          onBlur={() => onNear(null)}
          onClick={() => onPick({ key: group.key })}
        >
          <LineSwatch style={groupStyle(group, scheme)} />
          {group.label}
        </button>
      ))}
      <span className={`faint ${classes.statistic}`}>{statistic}</span>
    </div>
  );
}

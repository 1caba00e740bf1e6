/** How probably a run of one method beats a run of another: rows against columns. */
import type { Group, Improvement } from '@/client/schema.gen';
import { LineSwatch } from '@/components/line-swatch';
import { formatShare, NOTHING } from '@/lib/format';
import { groupStyle, type Scheme } from '@/lib/palette';
import classes from './best.module.css';

interface Props {
  improvements: readonly Improvement[];
  groups: readonly Group[];
  scheme: Scheme;
}

/** Even odds: neither is better. */
const EVEN = 0.5;
/** Beyond so many methods the server pairs none. */
const MOST_PAIRED = 40;
/** The strongest shade that text stays readable on [%]. */
const STRONGEST = 56;

export function ImprovementMatrix({ improvements, groups, scheme }: Props) {
  const shown = groups.filter(({ key }) => improvements.some(({ first, second }) => first === key || second === key));
  if (shown.length === 0 && groups.length > MOST_PAIRED)
    return <p className="faint">More than {MOST_PAIRED} methods are not set against each other; show fewer of them.</p>;
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
    <section className={classes.frame} tabIndex={0} aria-label="Probability of improvement, matrix">
      <table className={classes.matrix}>
        <thead>
          <tr>
            <th scope="col">This method beats</th>
            {shown.map(({ key, label }) => (
              <th key={key} scope="col">
                {label}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {shown.map((group) => (
            <tr key={group.key}>
              <th scope="row">
                <span className={classes.name}>
                  <LineSwatch style={groupStyle(group, scheme)} />
                  {group.label}
                </span>
              </th>
              {shown.map((other) => (
                <Cell
                  key={other.key}
                  pair={improvements.find(({ first, second }) => first === group.key && second === other.key)}
                />
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}

function Cell({ pair }: { pair: Improvement | undefined }) {
  if (pair === undefined) return <td className="faint">{NOTHING}</td>;
  const { probability, low, high } = pair;
  const isSure = low !== null && high !== null && (low > EVEN || high < EVEN);
  const shade = Math.round(Math.max(0, probability - EVEN) * STRONGEST);
  return (
    <td
      style={{ background: `color-mix(in srgb, var(--state-succeeded) ${shade}%, transparent)` }}
      data-sure={isSure || undefined}
    >
      {formatShare(probability)}
      <span>{low === null || high === null ? 'too few seeds' : `${formatShare(low)} to ${formatShare(high)}`}</span>
    </td>
  );
}

/** The paper's bar figure: the best test success of every method in every task, its interval, and each seed. */
import type { BestScore, Group } from '@/client/schema.gen';
import type { Emphasis } from '@/lib/curves';
import { formatShare } from '@/lib/format';
import { groupFill, groupStyle, type Scheme } from '@/lib/palette';
import { byFamily } from '../families';
import classes from './best.module.css';

interface Props {
  scores: readonly BestScore[];
  groups: readonly Group[];
  scheme: Scheme;
  emphasis: Emphasis | null;
  onNear: (emphasis: Emphasis | null) => void;
}

export function BestBars({ scores, groups, ...look }: Props) {
  const tasks = [...new Set(scores.map(({ task }) => task))].map((task) => ({ task }));
  return (
    <div className={classes.families}>
      {byFamily(tasks).map(({ title, things }) => (
        <section key={title} aria-label={title} className={classes.family}>
          <h3>{title}</h3>
          <div className={classes.tasks}>
            {things.map(({ task }) => (
              <TaskBars key={task} task={task} scores={scores} groups={groups} {...look} />
            ))}
          </div>
        </section>
      ))}
    </div>
  );
}

function TaskBars({ task, scores, groups, ...look }: Props & { task: string }) {
  return (
    <div className={classes.task}>
      <ul className={classes.bars} aria-label={task}>
        {groups.map((group) => {
          const score = scores.find((other) => other.task === task && other.group === group.key);
          return score && <Bar key={group.key} group={group} score={score} {...look} />;
        })}
      </ul>
      <p>{task}</p>
    </div>
  );
}

interface BarProps extends Pick<Props, 'scheme' | 'emphasis' | 'onNear'> {
  group: Group;
  score: BestScore;
}

function Bar({ group, score: { centre, low, high, n, seeds }, scheme, emphasis, onNear }: BarProps) {
  const { color } = groupStyle(group, scheme);
  const words = describe(group.label, centre, low, high, n);
  return (
    <li
      className={classes.bar}
      title={words}
      data-faded={(emphasis !== null && emphasis.key !== group.key) || undefined}
      onMouseEnter={() => onNear({ key: group.key })}
      onMouseLeave={() => onNear(null)}
    >
      <span className="hidden">{words}</span>
      {centre !== null && (
        <span
          className={classes.filled}
          style={{ height: percent(centre), background: groupFill(group, scheme), borderColor: color }}
        />
      )}
      {low !== null && high !== null && (
        <span className={classes.whisker} style={{ bottom: percent(low), height: percent(high - low) }} />
      )}
      {seeds.map(({ run_id, best }) => (
        <span key={run_id} className={classes.seed} style={{ bottom: percent(best), borderColor: color }} />
      ))}
    </li>
  );
}

function describe(label: string, centre: number | null, low: number | null, high: number | null, n: number): string {
  const interval = low === null || high === null ? '' : ` (${formatShare(low, 1)} to ${formatShare(high, 1)})`;
  return `${label}: ${formatShare(centre, 1)}${interval}, n ${n}`;
}

function percent(share: number): string {
  return `${(100 * share).toFixed(2)}%`;
}

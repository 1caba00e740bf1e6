/** How much each method needs in each task until a test first reaches a success. */
import type { Efficiency, Group } from '@/client/schema.gen';
import { NumberTable } from '@/components/number-table';
import { formatX } from '@/lib/axes';
import type { Effort } from '../search';
import classes from './best.module.css';

interface Props {
  efficiency: readonly Efficiency[];
  groups: readonly Group[];
  effort: Effort;
  reached: number;
}

export function EfficiencyTable({ efficiency, groups, effort, reached }: Props) {
  const counted = efficiency.filter(({ axis, threshold }) => axis === effort && threshold === reached);
  const tasks = [...new Set(counted.map(({ task }) => task))];
  const shown = groups.filter(({ key }) => counted.some(({ group }) => group === key));
  const cellOf = (task: string, key: string) => {
    const found = counted.find((other) => other.task === task && other.group === key);
    return found === undefined ? null : (
      <Needed key={key} found={found} effort={effort} isLeast={isLeast(found, counted)} />
    );
  };
  return (
    <NumberTable
      name="Efficiency by task and method"
      columns={['Task', ...shown.map(({ label }) => label)]}
      rows={tasks.map((task) => [task, ...shown.map(({ key }) => cellOf(task, key))])}
    />
  );
}

/** Whether no method needs less in the same task. */
function isLeast({ task, median }: Efficiency, counted: readonly Efficiency[]): boolean {
  return median !== null && counted.every((other) => other.task !== task || (other.median ?? median) >= median);
}

function Needed({ found, effort, isLeast }: { found: Efficiency; effort: Effort; isLeast: boolean }) {
  const { median, low, high, reached, n } = found;
  const text = (value: number | null): string => (value === null ? 'more' : formatX(effort, value));
  return (
    <span className={classes.needed} data-least={isLeast || undefined}>
      <span>{median === null ? 'not reached' : text(median)}</span>
      <span className="faint">
        {median === null ? '' : `${text(low)} to ${text(high)}, `}
        {reached} of {n}
      </span>
    </span>
  );
}

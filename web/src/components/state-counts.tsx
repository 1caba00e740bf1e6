/** How many runs are in each state, as icons with numbers. */
import type { RunState } from '@/client/schema.gen';
import { Icon } from '@/components/icon';
import { countedStates } from '@/lib/studies';
import classes from './state-counts.module.css';

export function StateCounts({ states }: { states: Partial<Record<RunState, number>> }) {
  return (
    <span className={classes.counts}>
      {countedStates(states).map(([state, count]) => (
        <span key={state} className={classes.count} data-state={state} title={`${count} ${state}`}>
          <Icon name={state} size={12} />
          {count}
          <span className="hidden"> {state}</span>
        </span>
      ))}
    </span>
  );
}

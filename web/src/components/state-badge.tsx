/** A run's state as icon, word and colour. */
import { Tooltip } from '@mantine/core';
import type { RunState } from '@/client/schema.gen';
import { Icon } from '@/components/icon';
import { STATE_MEANING, WISH_MEANING, type Wish } from '@/lib/states';
import classes from './state-badge.module.css';

interface Props {
  state: RunState;
  /** What a person has asked of it and will happen soon. */
  wish?: Wish;
}

export function StateBadge({ state, wish }: Props) {
  return (
    <Tooltip label={wish ? WISH_MEANING[wish] : STATE_MEANING[state]} openDelay={400}>
      <span className={classes.badge} data-state={state}>
        <Icon name={state} size={13} />
        {wish ?? state}
      </span>
    </Tooltip>
  );
}

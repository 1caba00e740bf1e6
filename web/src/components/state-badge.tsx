/** A run's state as icon, word and colour. */
import { Tooltip } from '@mantine/core';
import type { RunState } from '@/client/schema.gen';
import { Icon } from '@/components/icon';
import { STATE_MEANING } from '@/lib/states';
import classes from './state-badge.module.css';

export function StateBadge({ state, ending = false }: { state: RunState; ending?: boolean }) {
  return (
    <Tooltip label={ending ? 'It will end at its next step.' : STATE_MEANING[state]} openDelay={400}>
      <span className={classes.badge} data-state={state}>
        <Icon name={state} size={13} />
        {ending ? 'cancelling' : state}
      </span>
    </Tooltip>
  );
}

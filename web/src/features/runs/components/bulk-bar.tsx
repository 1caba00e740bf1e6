/** What can be done with the selected runs. */
import { Button, Popover } from '@mantine/core';
import { useDisclosure } from '@mantine/hooks';
import type { RunSummary } from '@/client/schema.gen';
import { ACTION_ICONS } from '@/components/action-icons';
import { Icon } from '@/components/icon';
import { OnlyFor } from '@/components/only-for';
import { PriorityField } from '@/components/priority-field';
import { useRunActing } from '@/components/run-acting';
import { useComplaint, useToast } from '@/components/toasts';
import { formatPlural } from '@/lib/format';
import { ACTION_MEANING, ACTION_NAMES, ACTIONS, type Action, allowing } from '@/lib/run-actions';
import { hasEnded } from '@/lib/states';
import { useSetPriority } from '@/lib/use-run-actions';
import type { Selection } from '../use-selection';
import { BulkCompare } from './bulk-compare';
import { BulkTags } from './bulk-tags';
import classes from './runs.module.css';

interface Props {
  /** The selected runs. */
  runs: readonly RunSummary[];
  selection: Selection;
  /** Runs that pass the filters, in view or not. */
  total: number;
  /** Whether a run is kept fresh by a line in view. */
  isAtHand: (runId: string) => boolean;
  /** Select them all; left out where that is done, or there are too many. */
  onSelectAll?: () => void;
}

export function BulkBar({ runs, selection, total, isAtHand, onSelectAll }: Props) {
  const { act, isActing, question } = useRunActing((action, doneIds) => {
    // Deleted or restored rows are gone from this list; the others stay at hand for the next step.
    if (action === 'delete' || action === 'restore') selection.clear();
    // Nobody tells of the rest how they stand now.
    else
      selection.set(
        runs.filter(({ id }) => doneIds.includes(id) && !isAtHand(id)),
        false,
      );
  }, isAtHand);
  const waiting = runs.filter((run) => !hasEnded(run.state) && run.deleted_at === null);
  return (
    <div className={classes.bulk} role="toolbar" aria-label="Selected runs">
      <b className="number">{formatPlural(runs.length, 'run')} selected</b>
      {onSelectAll && (
        <Button variant="subtle" size="compact-xs" onClick={onSelectAll}>
          Select all {total}
        </Button>
      )}
      <span className={classes.bulkActions}>
        <OnlyFor least="operator">
          {ACTIONS.map((action) => (
            <BulkAction key={action} action={action} runs={runs} isBusy={isActing} onAct={act} />
          ))}
          {waiting.length > 0 && <BulkPriority runs={waiting} />}
          <BulkTags runs={runs} />
        </OnlyFor>
        <BulkCompare runs={runs} />
      </span>
      <Button variant="subtle" size="compact-sm" onClick={selection.clear}>
        Clear
      </Button>
      {question}
    </div>
  );
}

interface ActionProps {
  action: Action;
  runs: readonly RunSummary[];
  isBusy: boolean;
  onAct: (action: Action, runs: readonly RunSummary[]) => void;
}

function BulkAction({ action, runs, isBusy, onAct }: ActionProps) {
  const fitting = allowing(runs, action);
  if (fitting.length === 0) return null;
  return (
    <Button
      variant="default"
      size="compact-sm"
      disabled={isBusy}
      leftSection={<Icon name={ACTION_ICONS[action]} size={13} />}
      title={ACTION_MEANING[action]}
      onClick={() => onAct(action, fitting)}
    >
      {ACTION_NAMES[action]}
      {fitting.length < runs.length && <span className="faint">&nbsp;{fitting.length}</span>}
    </Button>
  );
}

function BulkPriority({ runs }: { runs: readonly RunSummary[] }) {
  const [isOpen, { toggle, close }] = useDisclosure(false);
  const toast = useToast();
  const complain = useComplaint();
  const setting = useSetPriority();
  const [shared = null, ...others] = new Set(runs.map((run) => run.priority));
  const set = (priority: number): Promise<void> => {
    const runIds = runs.map((run) => run.id);
    close();
    // What became of it is told wherever one is by then.
    const done = setting.mutateAsync({ runIds, priority });
    done.then(() => toast({ text: `${formatPlural(runs.length, 'run')} now of priority ${priority}.` }), complain);
    return done;
  };
  return (
    <Popover opened={isOpen} onChange={close} position="top" withArrow>
      <Popover.Target>
        <Button variant="default" size="compact-sm" onClick={toggle} leftSection={<Icon name="up" size={13} />}>
          Priority
        </Button>
      </Popover.Target>
      <Popover.Dropdown>
        <div className={classes.priority}>
          <span>Higher starts first, 0 is usual.</span>
          <PriorityField
            value={others.length > 0 ? null : shared}
            label="Priority of the selected runs"
            onSet={set}
            isEager
          />
        </div>
      </Popover.Dropdown>
    </Popover>
  );
}

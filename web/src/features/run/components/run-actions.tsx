/** What can be done with the run: the nearest thing as a button, everything in a menu. */
import { Button, Menu } from '@mantine/core';
import { useNavigate } from '@tanstack/react-router';
import type { RunDetail } from '@/client/schema.gen';
import { ACTION_ICONS } from '@/components/action-icons';
import { Icon } from '@/components/icon';
import { useRunActing } from '@/components/run-acting';
import { ACTION_MEANING, ACTION_NAMES, ACTIONS, type Action, allows } from '@/lib/run-actions';
import classes from './run.module.css';

/** Actions that end or hide something stand apart in the menu. */
const HARSH: readonly Action[] = ['cancel', 'delete'];

export function RunActions({ run }: { run: RunDetail }) {
  const navigate = useNavigate();
  // Whoever deletes a run wants it out of sight; the notice that stays can bring it back.
  const { act, isActing, question } = useRunActing((action) => {
    if (action === 'delete') void navigate({ to: '/' });
  });
  const possible = ACTIONS.filter((action) => allows(run, action));
  const [nearest] = possible.filter((action) => !HARSH.includes(action));
  return (
    <>
      {nearest && (
        <Button
          variant="default"
          size="xs"
          loading={isActing}
          leftSection={<Icon name={ACTION_ICONS[nearest]} size={13} />}
          title={ACTION_MEANING[nearest]}
          onClick={() => act(nearest, [run])}
        >
          {ACTION_NAMES[nearest]}
        </Button>
      )}
      <Menu position="bottom-end" withinPortal>
        <Menu.Target>
          <Button variant="default" size="xs" rightSection={<Icon name="down" size={12} />}>
            Actions
          </Button>
        </Menu.Target>
        <Menu.Dropdown>
          {possible.length === 0 && <Menu.Label>It is ending; wait a moment.</Menu.Label>}
          {possible.map((action) => (
            <Menu.Item
              key={action}
              leftSection={<Icon name={ACTION_ICONS[action]} size={14} />}
              color={HARSH.includes(action) ? 'var(--state-failed)' : undefined}
              onClick={() => act(action, [run])}
            >
              <span className={classes.menuItem}>
                {ACTION_NAMES[action]}
                <span className="faint">{ACTION_MEANING[action]}</span>
              </span>
            </Menu.Item>
          ))}
        </Menu.Dropdown>
      </Menu>
      {question}
    </>
  );
}

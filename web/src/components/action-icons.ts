/** The icon of each action. */
import type { IconName } from '@/components/icon';
import type { Action } from '@/lib/run-actions';

export const ACTION_ICONS: Record<Action, IconName> = {
  resume: 'running',
  release: 'release',
  retry: 'retry',
  pause: 'paused',
  cancel: 'cancelled',
  delete: 'trash',
  restore: 'retry',
};

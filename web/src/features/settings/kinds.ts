/** What can be removed of ended runs, in words. */
import type { Removable } from '@/client/schema.gen';

export const KINDS: readonly { kind: Removable; label: string; summary: string }[] = [
  {
    kind: 'replay',
    label: 'Replay files and checkpoints',
    summary: 'Nearly all of a run’s size. A failed or cancelled run then begins anew when it is tried again.',
  },
  { kind: 'policies', label: 'Policies of single epochs', summary: 'The newest and the best policy stay.' },
  { kind: 'episodes', label: 'Recorded test episodes', summary: 'They can then no longer be played.' },
  { kind: 'videos', label: 'Videos', summary: 'They can be drawn again.' },
  { kind: 'recordings', label: 'Rerun files', summary: 'They can be made again.' },
];

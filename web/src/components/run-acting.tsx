/** Do something to runs: ask first where something is lost, say what became of it, offer the way back. */
import { lazy, type ReactNode, Suspense, useState } from 'react';
import type { ActionResult } from '@/client/schema.gen';
import { useComplaint, useToast } from '@/components/toasts';
import { type Actable, type Action, summarise } from '@/lib/run-actions';
import { useFocusBack } from '@/lib/use-focus-back';
import { useRunActions } from '@/lib/use-run-actions';

/** Few runs are cancelled while they train, and the dialog is half of what is loaded for it. */
const CancelQuestion = lazy(() =>
  import('@/components/cancel-question').then((part) => ({ default: part.CancelQuestion })),
);

export interface RunActing {
  /** Do it, or ask first. */
  readonly act: (action: Action, runs: readonly Actable[]) => void;
  readonly isActing: boolean;
  /** The question, to be put anywhere on the page. */
  readonly question: ReactNode;
}

/**
 * @param onDone called with the ids for which it was done, unless one has left by then
 * @param isFresh whether what is known of a run is what it is now; one that is not may have begun to train
 */
export function useRunActing(
  onDone?: (action: Action, runIds: readonly string[]) => void,
  isFresh: (runId: string) => boolean = () => true,
): RunActing {
  const toast = useToast();
  const complain = useComplaint();
  const wishes = useRunActions();
  const [asked, setAsked] = useState<readonly Actable[] | null>(null);
  useFocusBack(asked !== null && asked.length > 0);

  // What became of it is told wherever one is by then; what the page does about it is for the page that asked.
  const send = (action: Action, runIds: readonly string[]): void => {
    const tell = ({ results }: { results: ActionResult[] }): void => {
      const { doneIds, ...notice } = summarise(action, results);
      const undo = action === 'delete' && doneIds.length > 0 ? () => send('restore', doneIds) : undefined;
      toast({ ...notice, undo });
    };
    const onSuccess = ({ results }: { results: ActionResult[] }): void => {
      const { doneIds } = summarise(action, results);
      if (doneIds.length > 0) onDone?.(action, doneIds);
    };
    wishes.mutateAsync({ action, runIds }, { onSuccess }).then(tell, complain);
  };
  const act = (action: Action, runs: readonly Actable[]): void => {
    if (action === 'cancel' && runs.some((run) => run.state === 'running' || !isFresh(run.id))) setAsked(runs);
    else
      send(
        action,
        runs.map((run) => run.id),
      );
  };
  const close = (): void => setAsked([]);
  const confirm = (): void => {
    send(
      'cancel',
      (asked ?? []).map((run) => run.id),
    );
    close();
  };
  const question = asked && (
    <Suspense fallback={null}>
      <CancelQuestion runs={asked} onKeep={close} onConfirm={confirm} />
    </Suspense>
  );
  return { act, isActing: wishes.isPending, question };
}

/** A wish that a dialog sends: done, it is told and the dialog closes; refused, all stays and the error says why. */
import { useEffect, useRef } from 'react';
import { useComplaint, useToast } from '@/components/toasts';
import { type StudyWish, useStudyAction } from '@/lib/use-study-action';

export function useDialogWish(onClose: () => void) {
  const toast = useToast();
  const complain = useComplaint();
  const { mutateAsync, error, isPending } = useStudyAction();
  const isThere = useRef(true);
  useEffect(() => {
    isThere.current = true;
    return () => {
      isThere.current = false;
    };
  }, []);
  // What became of it is told wherever one is by then.
  const tell = (text: string): void => {
    toast({ text });
    if (isThere.current) onClose();
  };
  const refuse = (reason: unknown): void => {
    if (!isThere.current) complain(reason);
  };
  const send = (wish: StudyWish): void => {
    mutateAsync(wish).then(tell, refuse);
  };
  return { send, error, isPending };
}

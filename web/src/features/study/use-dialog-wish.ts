/** A wish that a dialog sends: done, it is told and the dialog closes; refused, all stays and the error says why. */
import { useToast } from '@/components/toasts';
import { type StudyWish, useStudyAction } from '@/lib/use-study-action';

export function useDialogWish(onClose: () => void) {
  const toast = useToast();
  const { mutate, error, isPending } = useStudyAction();
  const send = (wish: StudyWish): void =>
    mutate(wish, {
      onSuccess: (text) => {
        toast({ text });
        onClose();
      },
    });
  return { send, error, isPending };
}

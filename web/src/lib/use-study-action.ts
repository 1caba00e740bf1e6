/** Do something to a study that needs no further words; what shows it is fetched again. */
import { useMutation, useQueryClient } from '@tanstack/react-query';
import type { StudyAddition, StudyChange } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';

/** What can be asked of a study. */
export type StudyWish = { readonly studyId: string } & (
  | { readonly action: 'fill' | 'retry-failed' | 'retry-cancelled' | 'delete' | 'restore' }
  | { readonly action: 'extend'; readonly addition: StudyAddition }
  | { readonly action: 'change'; readonly change: StudyChange }
);

export function useStudyAction() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: send,
    onSuccess: () =>
      Promise.all(
        [['studies'], ['study-preview'], ['runs'], ['queue']].map((queryKey) =>
          queries.invalidateQueries({ queryKey }),
        ),
      ),
  });
}

/** Return what was done, in one sentence. */
async function send(wish: StudyWish): Promise<string> {
  const params = { path: { study_id: wish.studyId } };
  switch (wish.action) {
    case 'fill':
      return queued(await unwrap(client.POST('/api/studies/{study_id}/fill', { params })));
    case 'extend':
      return queued(await unwrap(client.POST('/api/studies/{study_id}/extend', { params, body: wish.addition })));
    case 'retry-failed':
    case 'retry-cancelled': {
      const body = { cancelled: wish.action === 'retry-cancelled' };
      const { results } = await unwrap(client.POST('/api/studies/{study_id}/retry', { params, body }));
      const refused = results.filter((result) => !result.done).map((result) => result.message);
      return [`${results.length - refused.length} of ${results.length} are tried again.`, ...refused.slice(0, 1)].join(
        ' ',
      );
    }
    case 'change':
      await unwrap(client.PATCH('/api/studies/{study_id}', { params, body: wish.change }));
      return 'The study is changed.';
    case 'delete':
      await unwrap(client.DELETE('/api/studies/{study_id}', { params }));
      return 'The study is deleted; its runs stay.';
    case 'restore':
      await unwrap(client.POST('/api/studies/{study_id}/restore', { params }));
      return 'The study is back.';
  }
}

function queued({ queued: made, joined }: { queued: number; joined: number }): string {
  if (made + joined === 0) return 'Nothing is missing.';
  return `${made} queued, ${joined} reused.`;
}

/** The button that opens the studies that come with the product, with real results; none if none comes with it. */
import { Button } from '@mantine/core';
import { queryOptions, useMutation, useQuery, useQueryClient } from '@tanstack/react-query';
import { useRouter } from '@tanstack/react-router';
import { useToast } from '@/components/toasts';
import { useMay } from '@/lib/access';
import { client, sentence, unwrap } from '@/lib/api';

/** How many there are; it changes only with the server's version. */
const sampleQuery = queryOptions({
  queryKey: ['sample-studies'],
  queryFn: ({ signal }) => unwrap(client.GET('/api/study-files/sample', { signal })),
  staleTime: Number.POSITIVE_INFINITY,
});

/** @param isQuiet whether it stands among other ways, and not in place of what is missing */
export function OpenSample({ isQuiet = false }: { isQuiet?: boolean }) {
  const { data } = useQuery(sampleQuery);
  const toast = useToast();
  const queries = useQueryClient();
  const router = useRouter();
  const isMine = useMay('operator');
  const opening = useMutation({
    mutationFn: (_pathname: string) => unwrap(client.POST('/api/study-files/sample')),
    onSuccess: async ({ studies }, pathname) => {
      await Promise.all([['studies'], ['runs']].map((queryKey) => queries.invalidateQueries({ queryKey })));
      const [first, ...others] = studies;
      if (studies.every((study) => study.already_there)) {
        toast({ text: `The sample ${others.length === 0 ? 'study was' : 'studies were'} here already.` });
      }
      // Who has left meanwhile is not called away.
      if (router.state.location.pathname !== pathname) return;
      if (first === undefined || others.length > 0) await router.navigate({ to: '/studies' });
      else await router.navigate({ to: '/studies/$studyId', params: { studyId: first.study_id } });
    },
  });
  if (!data || data.files === 0 || !isMine) return null;
  return (
    <>
      <Button
        size={isQuiet ? undefined : 'lg'}
        variant={isQuiet ? 'subtle' : 'default'}
        loading={opening.isPending}
        title="Real results, made with this product: look at curves, statistics and 3D before you train anything."
        onClick={() => opening.mutate(router.state.location.pathname)}
      >
        {data.files === 1 ? 'Open the sample study' : 'Open the sample studies'}
      </Button>
      {opening.error && (
        <p className="problem" role="alert">
          {sentence(opening.error)}
        </p>
      )}
    </>
  );
}

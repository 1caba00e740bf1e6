/** The browsers that are signed in to one's account. */
import { Button } from '@mantine/core';
import { useMutation, useQuery, useQueryClient } from '@tanstack/react-query';
import { CardSection } from '@/components/card-section';
import { NumberTable } from '@/components/number-table';
import { client, sentence, unwrap } from '@/lib/api';
import { formatMoment } from '@/lib/format';

const KEY = ['account', 'sessions'];

export function SessionList() {
  const queries = useQueryClient();
  const { data, error } = useQuery({
    queryKey: KEY,
    queryFn: ({ signal }) => unwrap(client.GET('/api/account/sessions', { signal })),
  });
  const end = useMutation({
    mutationFn: async (id: string): Promise<void> => {
      const params = { path: { session_id: id } };
      await unwrap<unknown>(client.DELETE('/api/account/sessions/{session_id}', { params }));
    },
    onSettled: () => queries.invalidateQueries({ queryKey: KEY }),
  });
  const problem = end.error ?? error;
  return (
    <CardSection title="Where you are signed in" note="End what you do not know.">
      <NumberTable
        name="Sessions"
        columns={['Browser', 'Address', 'Signed in', 'Last seen', '']}
        wordColumns={4}
        rows={(data?.sessions ?? []).map((session) => [
          `${shortAgent(session.agent)}${session.is_this ? ', this one' : ''}`,
          session.address,
          formatMoment(session.created_at),
          formatMoment(session.seen_at),
          <Button
            key="end"
            variant="default"
            size="compact-xs"
            aria-label={`End the session of ${shortAgent(session.agent)} at ${session.address}`}
            onClick={() => end.mutate(session.id)}
          >
            End
          </Button>,
        ])}
      />
      {problem && (
        <p className="problem" role="alert">
          {sentence(problem)}
        </p>
      )}
    </CardSection>
  );
}

/** The name of a browser, of all that it says about itself. */
function shortAgent(agent: string): string {
  const known = /(Firefox|Edg|OPR|Chromium|Chrome|Safari)\/(\d+)/.exec(agent);
  return known ? `${known[1] === 'Edg' ? 'Edge' : known[1]} ${known[2]}` : agent.slice(0, 40) || 'unknown';
}

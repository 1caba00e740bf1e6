/** Who did what, when, from where, and what came of it. */
import { Button, NativeSelect } from '@mantine/core';
import { useInfiniteQuery } from '@tanstack/react-query';
import { useState } from 'react';
import type { AuditRecord } from '@/client/schema.gen';
import { CardSection } from '@/components/card-section';
import { NumberTable } from '@/components/number-table';
import { client, sentence, unwrap } from '@/lib/api';
import { formatMoment } from '@/lib/format';

type Outcome = AuditRecord['outcome'];

const OUTCOMES = [
  { value: '', label: 'everything' },
  { value: 'done', label: 'what was done' },
  { value: 'refused', label: 'what was refused' },
  { value: 'failed', label: 'what failed' },
];

export function AuditLog() {
  const [outcome, setOutcome] = useState('');
  const pages = useInfiniteQuery({
    queryKey: ['audit', outcome],
    queryFn: ({ pageParam, signal }) => {
      const query = { before: pageParam, outcome: (outcome || undefined) as Outcome | undefined };
      return unwrap(client.GET('/api/audit', { params: { query }, signal }));
    },
    initialPageParam: undefined as number | undefined,
    getNextPageParam: (last) => last.next ?? undefined,
  });
  const entries = pages.data?.pages.flatMap((page) => page.entries) ?? [];
  return (
    <CardSection title="Audit log" note="The newest first. Entries are kept for 400 days.">
      <NativeSelect
        label="Show"
        w={200}
        data={OUTCOMES}
        value={outcome}
        onChange={(event) => setOutcome(event.currentTarget.value)}
      />
      <NumberTable
        name="Audit log"
        columns={['When', 'Who', 'What', 'Outcome', 'From', 'Where', 'More']}
        wordColumns={7}
        mostRows={Number.POSITIVE_INFINITY}
        rows={entries.map((entry) => [
          formatMoment(entry.at),
          entry.who,
          entry.action,
          entry.outcome,
          entry.address,
          entry.target,
          entry.detail,
        ])}
      />
      {pages.hasNextPage && (
        <Button variant="default" onClick={() => pages.fetchNextPage()} loading={pages.isFetchingNextPage}>
          Older entries
        </Button>
      )}
      {pages.error && (
        <p className="problem" role="alert">
          {sentence(pages.error)}
        </p>
      )}
    </CardSection>
  );
}

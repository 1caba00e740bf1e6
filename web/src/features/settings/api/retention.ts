/** What a rule would remove of ended runs, and removing it. */
import { keepPreviousData, queryOptions, useMutation, useQueryClient } from '@tanstack/react-query';
import type { RetentionRule } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';

/** What a rule would remove now. */
export function retentionQuery({ kinds, older_than_days }: RetentionRule) {
  return queryOptions({
    queryKey: ['retention', kinds, older_than_days],
    queryFn: ({ signal }) =>
      unwrap(client.GET('/api/retention', { params: { query: { kind: kinds, older_than_days } }, signal })),
    enabled: kinds.length > 0,
    placeholderData: keepPreviousData,
  });
}

/** Remove what a rule names. */
export function useApplyRetention() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: (rule: RetentionRule) => unwrap(client.POST('/api/retention', { body: rule })),
    onSuccess: () => queries.invalidateQueries({ queryKey: ['retention'] }),
  });
}

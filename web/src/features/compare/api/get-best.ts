/** The best models of the chosen runs, compared. */
import { keepPreviousData, queryOptions } from '@tanstack/react-query';
import type { BestModels } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';
import type { CompareSearch } from '../search';
import { choiceOf } from './choice';
import { viewOf } from './get-curves';

/** How often it is asked for [ms]: bootstraps of a large study take a while, and the best changes slowly. */
const BEST_POLL_MS = 15_000;

export function bestQuery(search: CompareSearch) {
  const { statistic, level } = viewOf(search);
  const query = { ...choiceOf(search), statistic, level };
  return queryOptions({
    queryKey: ['compare', 'best', query],
    queryFn: ({ signal }) => unwrap(client.GET('/api/compare/best', { params: { query }, signal })),
    refetchInterval: BEST_POLL_MS,
    placeholderData: keepPreviousData,
    structuralSharing: (known, fresh) => {
      const [old, next] = [known as BestModels | undefined, fresh as BestModels];
      return old?.version === next.version ? old : next;
    },
  });
}

/** The whole page: its look, its data, its addresses. */
import { MantineProvider } from '@mantine/core';
import { MutationCache, QueryCache, QueryClient, QueryClientProvider, type QueryKey } from '@tanstack/react-query';
import { RouterProvider } from '@tanstack/react-router';
import { useState } from 'react';
import type { AppRouter } from '@/app/router';
import { cssVariables, theme } from '@/app/theme';
import type { Me } from '@/client/schema.gen';
import { Toasts } from '@/components/toasts';
import { isSignedOut, meQuery } from '@/lib/access';
import { reconnecting } from '@/lib/reconnecting';

export function App({ router }: { router: AppRouter }) {
  const [queries] = useState(() => makeQueryClient(router));
  return (
    <MantineProvider theme={theme} cssVariablesResolver={cssVariables} defaultColorScheme="auto">
      <QueryClientProvider client={queries}>
        <Toasts>
          <RouterProvider router={router} />
        </Toasts>
      </QueryClientProvider>
    </MantineProvider>
  );
}

/** Where people come in. */
const ENTRANCES: readonly string[] = ['/sign-in', '/welcome'];

/** When the server does not know who asks, lead to where that can be said, and back afterwards. */
function askToSignIn(router: AppRouter): void {
  void router.navigate({ to: '/sign-in', search: { from: router.state.location.href } });
}

function makeQueryClient(router: AppRouter): QueryClient {
  const isInside = (): boolean => !ENTRANCES.includes(router.state.location.pathname);
  const onError = (error: unknown): void => {
    if (!isSignedOut(error) || !isInside()) return;
    // Whoever was signed in until now is so no more.
    void queries.resetQueries(meQuery);
    askToSignIn(router);
  };
  // Some pages ask for nothing that is kept from strangers, and would stay empty.
  const onSuccess = (data: unknown, { queryKey }: { queryKey: QueryKey }): void => {
    if (queryKey[0] === meQuery.queryKey[0] && (data as Me).caller === null && isInside()) askToSignIn(router);
  };
  const queries = new QueryClient({
    queryCache: new QueryCache({ onError, onSuccess }),
    mutationCache: new MutationCache({ onError }),
    defaultOptions: {
      // The server may run on this very machine, so it is asked even when the browser believes to be offline.
      queries: { retry: false, networkMode: 'always', staleTime: 1_000, refetchInterval: reconnecting },
      mutations: { networkMode: 'always' },
    },
  });
  return queries;
}

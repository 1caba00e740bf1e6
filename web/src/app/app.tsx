/** The whole page: its look, its data, its addresses. */
import { MantineProvider } from '@mantine/core';
import { MutationCache, QueryCache, QueryClient, QueryClientProvider } from '@tanstack/react-query';
import { RouterProvider } from '@tanstack/react-router';
import { useState } from 'react';
import type { AppRouter } from '@/app/router';
import { cssVariables, theme } from '@/app/theme';
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

/** When the server does not know who asks, lead to where that can be said, and back afterwards. */
function askToSignIn(router: AppRouter, queries: QueryClient, error: unknown): void {
  const { href, pathname } = router.state.location;
  if (!isSignedOut(error) || pathname === '/sign-in' || pathname === '/welcome') return;
  // Whoever was signed in until now is so no more.
  void queries.resetQueries(meQuery);
  void router.navigate({ to: '/sign-in', search: { from: href } });
}

function makeQueryClient(router: AppRouter): QueryClient {
  const onError = (error: unknown): void => askToSignIn(router, queries, error);
  const queries = new QueryClient({
    queryCache: new QueryCache({ onError }),
    mutationCache: new MutationCache({ onError }),
    defaultOptions: {
      // The server may run on this very machine, so it is asked even when the browser believes to be offline.
      queries: { retry: false, networkMode: 'always', staleTime: 1_000, refetchInterval: reconnecting },
      mutations: { networkMode: 'always' },
    },
  });
  return queries;
}

/** What surrounds a page: the shell, or nothing before somebody is signed in. */
import { Outlet, useRouterState } from '@tanstack/react-router';
import { Shell } from '@/app/shell';

/** Pages for people who are not signed in. */
const ENTRANCES = ['/sign-in', '/welcome'];

export function Frame() {
  const path = useRouterState({ select: (state) => state.location.pathname });
  if (!ENTRANCES.includes(path)) return <Shell />;
  return (
    <main id="main">
      <Outlet />
    </main>
  );
}

/** Every address of the page, and what it shows. */
import {
  createRootRoute,
  createRoute,
  createRouter,
  lazyRouteComponent,
  parseSearchWith,
  type RouterHistory,
  stringifySearchWith,
} from '@tanstack/react-router';
import { PageBroke, PageNotFound } from '@/app/failures';
import { Frame } from '@/app/frame';
import { readCompareSearch, readConfigsSearch } from '@/features/compare/search';
import { readLaunchSearch } from '@/features/launch/search';
import { readNewStudySearch } from '@/features/new-study/search';
import { readRunSearch } from '@/features/run/search';
import { readRunsSearch } from '@/features/runs/search';
import { readSignInSearch } from '@/features/sign-in/search';
import { readStudiesSearch } from '@/features/studies/search';
import { readStudySearch } from '@/features/study/search';

const root = createRootRoute({ component: Frame });

const runs = createRoute({
  getParentRoute: () => root,
  path: '/',
  validateSearch: readRunsSearch,
  component: lazyRouteComponent(() => import('@/features/runs/runs-page'), 'RunsPage'),
});

const launch = createRoute({
  getParentRoute: () => root,
  path: '/launch',
  validateSearch: readLaunchSearch,
  component: lazyRouteComponent(() => import('@/features/launch/launch-page'), 'LaunchPage'),
});

const run = createRoute({
  getParentRoute: () => root,
  path: '/runs/$runId',
  validateSearch: readRunSearch,
  component: lazyRouteComponent(() => import('@/features/run/run-page'), 'RunPage'),
});

const studies = createRoute({
  getParentRoute: () => root,
  path: '/studies',
  validateSearch: readStudiesSearch,
  component: lazyRouteComponent(() => import('@/features/studies/studies-page'), 'StudiesPage'),
});

const newStudy = createRoute({
  getParentRoute: () => root,
  path: '/studies/new',
  validateSearch: readNewStudySearch,
  component: lazyRouteComponent(() => import('@/features/new-study/new-study-page'), 'NewStudyPage'),
});

const study = createRoute({
  getParentRoute: () => root,
  path: '/studies/$studyId',
  validateSearch: readStudySearch,
  component: lazyRouteComponent(() => import('@/features/study/study-page'), 'StudyPage'),
});

const queue = createRoute({
  getParentRoute: () => root,
  path: '/queue',
  component: lazyRouteComponent(() => import('@/features/queue/queue-page'), 'QueuePage'),
});

const workers = createRoute({
  getParentRoute: () => root,
  path: '/workers',
  component: lazyRouteComponent(() => import('@/features/workers/workers-page'), 'WorkersPage'),
});

const settings = createRoute({
  getParentRoute: () => root,
  path: '/settings',
  component: lazyRouteComponent(() => import('@/features/settings/settings-page'), 'SettingsPage'),
});

const compare = createRoute({
  getParentRoute: () => root,
  path: '/compare',
  validateSearch: readCompareSearch,
  component: lazyRouteComponent(() => import('@/features/compare/compare-page'), 'ComparePage'),
});

const configs = createRoute({
  getParentRoute: () => root,
  path: '/compare/configs',
  validateSearch: readConfigsSearch,
  component: lazyRouteComponent(() => import('@/features/compare/configs-page'), 'ConfigsPage'),
});

const signIn = createRoute({
  getParentRoute: () => root,
  path: '/sign-in',
  validateSearch: readSignInSearch,
  component: lazyRouteComponent(() => import('@/features/sign-in/sign-in-page'), 'SignInPage'),
});

const welcome = createRoute({
  getParentRoute: () => root,
  path: '/welcome',
  component: lazyRouteComponent(() => import('@/features/welcome/welcome-page'), 'WelcomePage'),
});

const account = createRoute({
  getParentRoute: () => root,
  path: '/account',
  component: lazyRouteComponent(() => import('@/features/account/account-page'), 'AccountPage'),
});

const accounts = createRoute({
  getParentRoute: () => root,
  path: '/accounts',
  component: lazyRouteComponent(() => import('@/features/accounts/accounts-page'), 'AccountsPage'),
});

/** What is there for people who come in, and for those who decide who may. */
const access = [signIn, welcome, account, accounts] as const;

/** Make the router; a test hands in a history of its own. */
export function makeRouter(history?: RouterHistory) {
  return createRouter({
    routeTree: root.addChildren([
      runs,
      launch,
      run,
      studies,
      newStudy,
      study,
      compare,
      configs,
      queue,
      workers,
      settings,
      ...access,
    ]),
    history,
    defaultNotFoundComponent: PageNotFound,
    defaultErrorComponent: PageBroke,
    scrollRestoration: true,
    // Every search value is a plain word, so addresses need no JSON quotes.
    parseSearch: parseSearchWith((value) => value),
    stringifySearch: stringifySearchWith(String),
  });
}

export type AppRouter = ReturnType<typeof makeRouter>;

declare module '@tanstack/react-router' {
  interface Register {
    router: AppRouter;
  }
}

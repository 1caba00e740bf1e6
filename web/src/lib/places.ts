/** The places of the page that every other place leads to, and the key of each after `g`. */

export type PlacePath = '/' | '/launch' | '/studies' | '/compare' | '/queue' | '/workers' | '/settings' | '/account';

export interface Place {
  readonly to: PlacePath;
  readonly label: string;
  readonly key: string;
}

/** What the rail lists, from top to bottom. */
export const PLACES: readonly Place[] = [
  { to: '/', label: 'Runs', key: 'r' },
  { to: '/launch', label: 'New run', key: 'l' },
  { to: '/studies', label: 'Studies', key: 's' },
  { to: '/compare', label: 'Compare', key: 'c' },
  { to: '/queue', label: 'Queue', key: 'q' },
  { to: '/workers', label: 'Workers', key: 'w' },
  { to: '/settings', label: 'Settings', key: 'e' },
];

/** What stands at the rail's foot. */
export const ACCOUNT: Place = { to: '/account', label: 'Account', key: 'a' };

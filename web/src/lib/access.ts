/** Who is signed in, and what they may do. */
import { queryOptions, useMutation, useQuery, useQueryClient } from '@tanstack/react-query';
import type { CallerInfo } from '@/client/schema.gen';
import { client, Refused, unwrap } from '@/lib/api';

export type Role = CallerInfo['role'];

/** What each role may do, the least first. */
export const ROLES: readonly { readonly name: Role; readonly may: string }[] = [
  { name: 'viewer', may: 'sees everything, changes nothing' },
  { name: 'operator', may: 'also launches, ends, tags and writes' },
  { name: 'admin', may: 'also decides who may do what' },
];

/** How people come in here, and who asks. */
export const meQuery = queryOptions({
  queryKey: ['me'],
  queryFn: ({ signal }) => unwrap(client.GET('/api/auth/me', { signal })),
  staleTime: 60_000, // [ms] a role changes rarely; the server looks at it with each request
});

/** Whether a role may do what needs another. */
export function allows(role: Role, needed: Role): boolean {
  const rank = (name: Role) => ROLES.findIndex((known) => known.name === name);
  return rank(role) >= rank(needed);
}

/** Whether whoever looks may do what needs a role. Until that is known nothing is kept from them: the server decides. */
export function useMay(needed: Role): boolean {
  const role = useQuery(meQuery).data?.caller?.role;
  return role === undefined || allows(role, needed);
}

/** Why a button is there and cannot be pressed. */
export const NOT_YOURS = 'Your role may look, not launch. An admin can give you the role operator.';

/** Whether the server does not know who asks. */
export function isSignedOut(error: unknown): boolean {
  return error instanceof Refused && error.status === 401;
}

/** Whatever was kept belongs to somebody else once another person is signed in. */
function useForget() {
  const queries = useQueryClient();
  return () => queries.getQueryCache().clear();
}

export type Entry =
  | { readonly way: 'token'; readonly token: string }
  | { readonly way: 'password'; readonly name: string; readonly password: string }
  | { readonly way: 'invitation'; readonly token: string; readonly password: string };

/** Come in. */
export function useSignIn() {
  const forget = useForget();
  return useMutation({
    mutationFn: async (entry: Entry): Promise<void> => {
      await unwrap<unknown>(send(entry));
    },
    onSuccess: forget,
  });
}

/** Go out. */
export function useSignOut() {
  const forget = useForget();
  return useMutation({
    mutationFn: async (): Promise<void> => {
      await unwrap<unknown>(client.POST('/api/auth/sign-out'));
    },
    onSuccess: forget,
  });
}

function send(entry: Entry) {
  switch (entry.way) {
    case 'token':
      return client.POST('/api/auth/enter', { body: { token: entry.token } });
    case 'password':
      return client.POST('/api/auth/sign-in', { body: { name: entry.name, password: entry.password } });
    case 'invitation':
      return client.POST('/api/auth/invitation/accept', { body: { token: entry.token, password: entry.password } });
  }
}

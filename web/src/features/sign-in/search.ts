/** What the sign-in page is told, as it stands in the address. */

export interface SignInSearch {
  /** The page to go to afterwards: a path of ours. */
  readonly from?: string;
  /** Why somebody landed here. */
  readonly reason?: 'token';
}

/** Read it from an address; what makes no sense, or leads elsewhere, is left out. */
export function readSignInSearch(raw: Record<string, unknown>): SignInSearch {
  const from = typeof raw.from === 'string' && /^\/(?![/\\])/.test(raw.from) ? raw.from : undefined;
  return { from, reason: raw.reason === 'token' ? 'token' : undefined };
}

/** What the list of studies shows, as it stands in the address. */

export interface StudiesSearch {
  /** Whether the deleted studies are shown, instead of all others. */
  readonly deleted?: 'yes';
}

/** Read it from an address; what makes no sense is left out. */
export function readStudiesSearch(raw: Record<string, unknown>): StudiesSearch {
  return { deleted: raw.deleted === 'yes' ? 'yes' : undefined };
}

/** What a new study begins with, as it stands in the address. */

export interface NewStudySearch {
  /** The name of a template. */
  readonly template?: string;
  /** The id of the study that it is a copy of. */
  readonly from?: string;
}

/** Read it from an address. */
export function readNewStudySearch(raw: Record<string, unknown>): NewStudySearch {
  const text = (key: string): string | undefined => (raw[key] ? String(raw[key]) : undefined);
  return { template: text('template'), from: text('from') };
}

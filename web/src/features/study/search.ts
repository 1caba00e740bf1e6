/** Which cell of the matrix is open, as it stands in the address. */

export interface StudySearch {
  readonly task?: string;
  readonly method?: string;
  readonly variant?: string;
}

/** Read it from an address. */
export function readStudySearch(raw: Record<string, unknown>): StudySearch {
  const text = (key: string): string | undefined => (raw[key] ? String(raw[key]) : undefined);
  return { task: text('task'), method: text('method'), variant: text('variant') };
}

/** Bring what the server refused to the fields it is about. */
import { Refused, sentence } from '@/lib/api';

/** A sentence for each field, and those that belong to none. */
export interface FieldProblems {
  readonly fields: Readonly<Record<string, string>>;
  readonly others: readonly string[];
}

const NO_PROBLEMS: FieldProblems = { fields: {}, others: [] };

/**
 * Sort the problems of a refused request by field.
 * @param known the fields that the form shows, settings by their dotted path
 */
export function fieldProblems(error: unknown, known: ReadonlySet<string>): FieldProblems {
  if (error === null || error === undefined) return NO_PROBLEMS;
  if (!(error instanceof Refused)) return { fields: {}, others: [sentence(error)] };
  const fields: Record<string, string> = {};
  const others: string[] = [];
  for (const { field, message } of error.problems) {
    const place = findField(field, known);
    if (place === undefined) others.push(field ? `${field}: ${message}` : message);
    else fields[place] = fields[place] === undefined ? message : `${fields[place]} ${message}`;
  }
  return { fields, others };
}

function findField(field: string | null, known: ReadonlySet<string>): string | undefined {
  if (field === null) return undefined;
  const name = field.replace(/^(body\.)?(overrides\.)?/, '');
  const parts = name.split('.');
  return parts
    .map((_, dropped) => parts.slice(0, parts.length - dropped).join('.'))
    .find((prefix) => known.has(prefix));
}

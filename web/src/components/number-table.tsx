/** The numbers behind a chart, as a plain table that scrolls within its place. */
import type { ReactNode } from 'react';
import classes from './number-table.module.css';

interface Props {
  /** What the numbers are. */
  name: string;
  columns: readonly string[];
  rows: readonly (readonly ReactNode[])[];
  /** The most that it takes of the page [px]; as much as it needs if left out. */
  height?: number;
  /** How many of the columns, from the left, hold words. */
  wordColumns?: number;
  /** How many rows are drawn at most, where a CSV has them all. */
  mostRows?: number;
}

/** As many rows as a page takes easily. */
const MOST_ROWS = 500;

export function NumberTable({ name, columns, rows, height, wordColumns = 1, mostRows = MOST_ROWS }: Props) {
  const shown = rows.slice(0, mostRows);
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
    <section className={classes.frame} style={{ maxHeight: height }} tabIndex={0} aria-label={`${name}, numbers`}>
      <table className={classes.table} aria-label={name}>
        <thead>
          <tr>
            {columns.map((column, at) => (
              <th key={column} scope="col" data-words={at < wordColumns || undefined}>
                {column}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {shown.map((cells, row) => (
            // biome-ignore lint/suspicious/noArrayIndexKey: rows are places of a table, with no name of their own
            <tr key={row}>
              {cells.map((cell, at) => (
                <td key={columns[at]} data-words={at < wordColumns || undefined}>
                  {cell}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
      {rows.length > mostRows && (
        <p className="faint">
          The first {mostRows} of {rows.length} rows; the CSV has them all.
        </p>
      )}
    </section>
  );
}

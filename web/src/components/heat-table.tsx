/** The numbers of a heat map. */
import { cellName } from '@/lib/heat-map';
import type { HeatMapProps } from './heat-map';
import classes from './heat-map.module.css';

export function HeatTable({ description, x, y, cells, format, tableEvery = 1 }: HeatMapProps) {
  const columns = every(x.edges.length - 1, tableEvery);
  const rows = every(y.edges.length - 1, tableEvery).toReversed();
  return (
    <details className={classes.numbers}>
      <summary>Numbers</summary>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard */}
      <section className={classes.tableFrame} tabIndex={0} aria-label={`${description} Numbers.`}>
        <table>
          <thead>
            <tr>
              <th scope="col">
                {y.name} \ {x.name}
              </th>
              {columns.map((column) => (
                <th key={column} scope="col">
                  {cellName(x, column)}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {rows.map((row) => (
              <tr key={row}>
                <th scope="row">{cellName(y, row)}</th>
                {columns.map((column) => (
                  <td key={column}>{format(cells[row]?.[column] ?? null)}</td>
                ))}
              </tr>
            ))}
          </tbody>
        </table>
      </section>
    </details>
  );
}

function every(count: number, step: number): number[] {
  return Array.from({ length: Math.ceil(count / step) }, (_, at) => at * step);
}

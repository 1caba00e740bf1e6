/** One figure of best models: what it shows, in words, and the table behind it. */
import { Button } from '@mantine/core';
import type { ReactNode } from 'react';
import type { PlainTable } from '@/client/schema.gen';
import { Icon } from '@/components/icon';
import { NumberTable } from '@/components/number-table';
import { formatValue, NOTHING } from '@/lib/format';
import classes from './best.module.css';

interface Props {
  title: string;
  /** What is drawn: statistic, number and level. */
  words: string;
  /** Named by the server; missing if there is nothing to tabulate. */
  table: PlainTable | undefined;
  isTable: boolean;
  onTable: (name: string) => void;
  controls?: ReactNode;
  children: ReactNode;
}

/** The most of the page that a table takes [px]. */
const TABLE_HEIGHT = 420;

export function FigureCard({ title, words, table, isTable, onTable, controls, children }: Props) {
  return (
    <figure className={`card ${classes.figure}`} aria-label={title}>
      <figcaption className={classes.caption}>
        <div>
          <h2>{title}</h2>
          <p className="faint">{words}</p>
        </div>
        {controls}
        {table && (
          <Button
            variant={isTable ? 'light' : 'subtle'}
            color="gray"
            size="compact-xs"
            leftSection={<Icon name="table" size={13} />}
            aria-pressed={isTable}
            onClick={() => onTable(table.name)}
          >
            Show table
          </Button>
        )}
      </figcaption>
      {isTable && table ? <Table table={table} /> : children}
    </figure>
  );
}

function Table({ table }: { table: PlainTable }) {
  const isWord = (at: number): boolean => table.rows.every((row) => typeof row[at] === 'string');
  const words = table.columns.findIndex((_, at) => !isWord(at));
  return (
    <NumberTable
      name={table.title}
      columns={table.columns.map(({ title }) => title)}
      rows={table.rows.map((row) =>
        row.map((cell) => (cell === null ? NOTHING : typeof cell === 'number' ? formatValue(cell) : cell)),
      )}
      height={TABLE_HEIGHT}
      wordColumns={words === -1 ? table.columns.length : words}
    />
  );
}

/** The head of the table: names of columns, which sort it. */
import { BUILT_INS, type BuiltIn } from '../columns';
import { parseMetricColumn, statisticName } from '../metric-columns';
import type { Sorting } from '../sorting';
import { turned } from '../sorting';
import classes from './lines.module.css';
import { SelectAllBox } from './select-all-box';

interface Props {
  columns: readonly BuiltIn[];
  metrics: readonly string[];
  sorting: Sorting;
  onSort: (sorting: Sorting) => void;
  allSelected: 'all' | 'some' | 'none';
  onSelectAll: (isSelected: boolean) => void;
}

export function TableHead({ columns, metrics, sorting, onSort, allSelected, onSelectAll }: Props) {
  return (
    <thead>
      <tr aria-rowindex={1}>
        <th scope="col">
          <SelectAllBox allSelected={allSelected} onSelectAll={onSelectAll} />
        </th>
        {columns.map((key) => (
          <ColumnHead
            key={key}
            name={BUILT_INS[key].name}
            isNumber={BUILT_INS[key].isNumber}
            help={BUILT_INS[key].help}
            sort={BUILT_INS[key].isSortable ? key : undefined}
            sorting={sorting}
            onSort={onSort}
          />
        ))}
        {metrics.map((text) => (
          <MetricHead key={text} text={text} sorting={sorting} onSort={onSort} />
        ))}
      </tr>
    </thead>
  );
}

function MetricHead({ text, sorting, onSort }: { text: string } & Pick<HeadProps, 'sorting' | 'onSort'>) {
  const column = parseMetricColumn(text);
  if (column === null) return null;
  return (
    <ColumnHead
      name={column.name}
      detail={statisticName(column)}
      isNumber
      help={`${column.name}, ${statisticName(column)}`}
      sort={text}
      sorting={sorting}
      onSort={onSort}
    />
  );
}

interface HeadProps {
  name: string;
  detail?: string;
  isNumber?: boolean;
  help?: string;
  /** What a click sorts by. */
  sort?: string;
  sorting: Sorting;
  onSort: (sorting: Sorting) => void;
}

export function ColumnHead({ name, detail, isNumber, help, sort, sorting, onSort }: HeadProps) {
  const isSorted = sort !== undefined && sorting.sort === sort;
  const order = sorting.descending ? 'descending' : 'ascending';
  const label = (
    <>
      <span className={classes.headName}>{name}</span>
      {detail && <span className={classes.headDetail}> {detail}</span>}
    </>
  );
  return (
    <th
      scope="col"
      data-number={isNumber || undefined}
      title={help}
      aria-sort={sort === undefined ? undefined : isSorted ? order : 'none'}
    >
      {sort === undefined ? (
        label
      ) : (
        <button
          type="button"
          className={classes.sort}
          data-sorted={isSorted || undefined}
          onClick={() => onSort(turned(sorting, sort))}
        >
          {label}
          <span aria-hidden="true" className={classes.arrow}>
            {isSorted ? (sorting.descending ? '↓' : '↑') : '↕'}
          </span>
        </button>
      )}
    </th>
  );
}

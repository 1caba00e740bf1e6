/** What passes the filters, as a CSV file: all rows, not only those in view. */
import { Button } from '@mantine/core';
import { Icon } from '@/components/icon';
import { groupQuery } from '../api/list-groups';
import { filterOf, filterQuery, type RunsSearch } from '../search';
import { runSortingOf } from '../sorting';

export function CsvLink({ search }: { search: RunsSearch }) {
  return (
    <Button
      component="a"
      href={csvAddress(search)}
      download
      variant="default"
      size="xs"
      leftSection={<Icon name="download" size={14} />}
    >
      CSV
    </Button>
  );
}

export function csvAddress(search: RunsSearch): string {
  const isGrouped = search.group !== undefined;
  const query = isGrouped
    ? groupQuery(search)
    : { ...filterQuery(filterOf(search)), ...runSortingOf(search), column: search.columns };
  const pairs = Object.entries(query).flatMap(([key, value]): [string, string][] =>
    value === undefined ? [] : [value].flat().map((one) => [key, String(one)]),
  );
  return `/api/${isGrouped ? 'run-groups' : 'runs'}.csv?${new URLSearchParams(pairs)}`;
}

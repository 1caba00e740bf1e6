/** All runs, live: a table that is filtered, sorted, grouped and labelled on the server. */
import { useMediaQuery } from '@mantine/hooks';
import { getRouteApi } from '@tanstack/react-router';
import { Suspense, useCallback, useState } from 'react';
import { ButtonLink } from '@/components/anchor-link';
import { Freshness } from '@/components/freshness';
import { Icon } from '@/components/icon';
import { OnlyFor } from '@/components/only-for';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatPlural } from '@/lib/format';
import { ColumnChooser } from './components/column-chooser';
import { CsvLink } from './components/csv-link';
import { FilterChips } from './components/filter-chips';
import { GroupChooser } from './components/group-chooser';
import { BulkBar, SortField } from './components/lazy-parts';
import { NoRuns } from './components/no-runs';
import { RunCards } from './components/run-cards';
import { FilterPanel, SearchField } from './components/run-filters';
import classes from './components/runs.module.css';
import { RunsTable } from './components/runs-table';
import { ViewsMenu } from './components/views-menu';
import type { Range } from './lines';
import type { RunsSearch } from './search';
import { useLines } from './use-lines';
import { MOST_SELECTED, useTable } from './use-table';

const route = getRouteApi('/');

/** Below this width every run is a card. */
const NARROW = '(max-width: 62em)';

/** Lines in view before anything is laid out. */
const AT_FIRST: Range = { first: 0, last: 40 };

export function RunsPage() {
  const search = route.useSearch();
  const navigate = route.useNavigate();
  const isNarrow = useMediaQuery(NARROW, window.matchMedia(NARROW).matches);
  const [shown, setShown] = useState(AT_FIRST);
  const lines = useLines(search, shown);
  const change = useCallback(
    (changes: RunsSearch): void => {
      void navigate({ search: (old) => ({ ...old, ...changes }), replace: true, resetScroll: false });
    },
    [navigate],
  );
  const table = useTable(search, lines, change);
  const { total } = lines;
  const selected = table.selection.runs.map((run) => lines.findRun(run.id) ?? run);
  const Lines = isNarrow ? RunCards : RunsTable;
  return (
    <>
      <title>Runs · SLDR</title>
      <div className="page-head">
        <h1>{search.deleted ? 'Deleted runs' : 'Runs'}</h1>
        <span className="faint number">{total !== undefined && formatPlural(total, 'run')}</span>
        <Freshness updatedAt={lines.updatedAt} />
        <OnlyFor least="operator">
          <ButtonLink to="/launch" leftSection={<Icon name="launch" size={14} />} ml="auto">
            New run
          </ButtonLink>
        </OnlyFor>
      </div>
      <search className={classes.tools}>
        <SearchField search={search} onChange={change} />
        <FilterPanel search={search} onChange={change} />
        <GroupChooser search={search} onChange={change} />
        <ColumnChooser search={search} hasTable={!isNarrow} onChange={change} />
        <Suspense fallback={null}>
          {(isNarrow || search.group) && <SortField search={search} onChange={change} />}
        </Suspense>
        <ViewsMenu />
        <CsvLink search={search} />
      </search>
      <FilterChips search={search} onChange={change} />
      {lines.error && (
        <SentencePanel urgent title="The runs cannot be shown">
          {sentence(lines.error)}
        </SentencePanel>
      )}
      {total === 0 && <NoRuns search={search} />}
      {lines.count > 0 && <Lines search={search} lines={lines} table={table} onRange={setShown} />}
      <Suspense fallback={null}>
        {selected.length > 0 && (
          <BulkBar
            runs={selected}
            selection={table.selection}
            total={total ?? 0}
            isAtHand={(id) => lines.findRun(id) !== undefined}
            onSelectAll={
              total !== undefined && selected.length < total && total <= MOST_SELECTED
                ? () => table.selectAll(true)
                : undefined
            }
          />
        )}
      </Suspense>
    </>
  );
}

/** All runs, live. */
import { Button } from '@mantine/core';
import { useMediaQuery } from '@mantine/hooks';
import { useInfiniteQuery } from '@tanstack/react-query';
import { getRouteApi } from '@tanstack/react-router';
import { useMemo } from 'react';
import type { RunSummary } from '@/client/schema.gen';
import { ButtonLink } from '@/components/anchor-link';
import { Freshness } from '@/components/freshness';
import { Icon } from '@/components/icon';
import { SampleStudy } from '@/components/sample-study';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatPlural } from '@/lib/format';
import { listRunsQuery } from './api/list-runs';
import { BulkBar } from './components/bulk-bar';
import { RunCards } from './components/run-cards';
import { RunFilters } from './components/run-filters';
import { RunsTable } from './components/runs-table';
import { isNarrowed, type RunsSearch, searchOf, sortingOf } from './search';
import { useSelection } from './use-selection';

const route = getRouteApi('/');

/** Below this width every run is a card. */
const NARROW = '(max-width: 62em)';

/** As many runs as one request may name. */
const MOST_SELECTED = 1000;

export function RunsPage() {
  const search = route.useSearch();
  const navigate = route.useNavigate();
  const isNarrow = useMediaQuery(NARROW, window.matchMedia(NARROW).matches);
  const { data, error, dataUpdatedAt, hasNextPage, fetchNextPage, isFetchingNextPage } = useInfiniteQuery(
    listRunsQuery(search),
  );
  const runs = useMemo(() => distinct(data?.pages.flatMap((page) => page.runs) ?? []), [data]);
  const selection = useSelection(runs.map((run) => run.id));
  const total = data?.pages[0]?.total ?? 0;
  const narrow = (changes: RunsSearch): void => {
    void navigate({ search: (old) => ({ ...old, ...changes }), replace: true });
  };
  const selectAll = async (): Promise<void> => {
    let pages = data?.pages ?? [];
    for (let more = hasNextPage; more; ) {
      const next = await fetchNextPage();
      pages = next.data?.pages ?? pages;
      more = next.hasNextPage && !next.isError;
    }
    selection.selectAll(pages.flatMap((page) => page.runs.map((run) => run.id)));
  };
  return (
    <>
      <title>Runs · SLDR</title>
      <div className="page-head">
        <h1>{search.deleted ? 'Deleted runs' : 'Runs'}</h1>
        <span className="faint number">{data && formatPlural(total, 'run')}</span>
        <Freshness updatedAt={dataUpdatedAt} />
        <ButtonLink to="/launch" leftSection={<Icon name="launch" size={14} />} ml="auto">
          New run
        </ButtonLink>
      </div>
      <RunFilters search={search} hasTable={!isNarrow} onChange={narrow} />
      {error && !data && (
        <SentencePanel urgent title="The runs cannot be shown">
          {sentence(error)}
        </SentencePanel>
      )}
      {data && runs.length === 0 && <NoRuns search={search} />}
      {runs.length > 0 &&
        (isNarrow ? (
          <RunCards runs={runs} selection={selection} />
        ) : (
          <RunsTable
            runs={runs}
            selection={selection}
            sorting={sortingOf(search)}
            onSort={(sorting) => narrow(searchOf(sorting))}
          />
        ))}
      {hasNextPage && (
        <Button variant="default" mt="md" loading={isFetchingNextPage} onClick={() => void fetchNextPage()}>
          Show more of {formatPlural(total, 'run')}
        </Button>
      )}
      {selection.ids.length > 0 && (
        <BulkBar
          runs={runs.filter((run) => selection.has(run.id))}
          selection={selection}
          total={total}
          onSelectAll={total <= MOST_SELECTED ? () => void selectAll() : undefined}
        />
      )}
    </>
  );
}

function NoRuns({ search }: { search: RunsSearch }) {
  if (isNarrowed(search)) {
    return (
      <SentencePanel
        title="No run matches these filters"
        actions={
          <ButtonLink to="/" search={{}} variant="default">
            Clear the filters
          </ButtonLink>
        }
      />
    );
  }
  if (search.deleted) {
    return (
      <SentencePanel
        title="No run is deleted"
        actions={
          <ButtonLink to="/" search={{}} variant="default">
            All other runs
          </ButtonLink>
        }
      >
        Deleted runs wait here and can be restored as they were.
      </SentencePanel>
    );
  }
  return (
    <SentencePanel
      title="Nothing has been trained yet"
      actions={
        <>
          <ButtonLink to="/launch" size="lg" variant="default">
            Launch the first run
          </ButtonLink>
          <SampleStudy />
        </>
      }
    >
      Choose a task, a method and seeds. An object first learns to move itself to its goal (locomotion); the robot then
      learns from it (manipulation). With the preset “quick” you can watch both happen. Or see everything at once: a
      two-minute study trains FetchPush with two methods and three seeds.
    </SentencePanel>
  );
}

/** A run that moved from one page to the next between two requests stands on both; once is enough. */
function distinct(runs: readonly RunSummary[]): RunSummary[] {
  return [...new Map(runs.map((run) => [run.id, run])).values()];
}

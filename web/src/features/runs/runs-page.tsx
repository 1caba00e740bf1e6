/** All runs, live. */
import { Button } from '@mantine/core';
import { useMediaQuery } from '@mantine/hooks';
import { useInfiniteQuery } from '@tanstack/react-query';
import { getRouteApi } from '@tanstack/react-router';
import { ButtonLink } from '@/components/anchor-link';
import { Freshness } from '@/components/freshness';
import { Icon } from '@/components/icon';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatPlural } from '@/lib/format';
import { listRunsQuery } from './api/list-runs';
import { RunCards } from './components/run-cards';
import { RunFilters } from './components/run-filters';
import { RunsTable } from './components/runs-table';
import { isNarrowed, type RunsSearch } from './search';

const route = getRouteApi('/');

/** Below this width every run is a card. */
const NARROW = '(max-width: 62em)';

export function RunsPage() {
  const search = route.useSearch();
  const navigate = route.useNavigate();
  const isNarrow = useMediaQuery(NARROW, window.matchMedia(NARROW).matches);
  const { data, error, dataUpdatedAt, hasNextPage, fetchNextPage, isFetchingNextPage } = useInfiniteQuery(
    listRunsQuery(search),
  );
  const runs = data?.pages.flatMap((page) => page.runs) ?? [];
  const total = data?.pages[0]?.total ?? 0;
  const narrow = (changes: RunsSearch): void => {
    void navigate({ search: (old) => ({ ...old, ...changes }), replace: true });
  };
  return (
    <>
      <title>Runs · SLDR</title>
      <div className="page-head">
        <h1>Runs</h1>
        <span className="faint number">{data && formatPlural(total, 'run')}</span>
        <Freshness updatedAt={dataUpdatedAt} />
        <ButtonLink to="/launch" leftSection={<Icon name="launch" size={14} />} ml="auto">
          New run
        </ButtonLink>
      </div>
      <RunFilters search={search} onChange={narrow} />
      {error && !data && (
        <SentencePanel urgent title="The runs cannot be shown">
          {sentence(error)}
        </SentencePanel>
      )}
      {data && runs.length === 0 && <NoRuns search={search} />}
      {runs.length > 0 && (isNarrow ? <RunCards runs={runs} /> : <RunsTable runs={runs} />)}
      {hasNextPage && (
        <Button variant="default" mt="md" loading={isFetchingNextPage} onClick={() => void fetchNextPage()}>
          Show more of {formatPlural(total, 'run')}
        </Button>
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
  return (
    <SentencePanel
      title="Nothing has been trained yet"
      actions={
        <ButtonLink to="/launch" size="lg">
          Launch the first run
        </ButtonLink>
      }
    >
      Choose a task, a method and seeds. An object first learns to move itself to its goal (locomotion); the robot then
      learns from it (manipulation). With the preset “quick” you can watch both happen.
    </SentencePanel>
  );
}

/** The episodes that tests recorded: how they ended over the training, a list, and what happened in one. */
import { Button, Select } from '@mantine/core';
import { useInfiniteQuery, useQuery, useQueryClient } from '@tanstack/react-query';
import { useMemo } from 'react';
import type { Episode, EpisodeList, RunDetail } from '@/client/schema.gen';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatPlural } from '@/lib/format';
import { hasEnded } from '@/lib/states';
import { metricsQuery } from '../api/get-metrics';
import type { RunSearch } from '../search';
import { EpisodeTable } from './episode-table';
import { EpisodeTimelines } from './episode-timelines';
import classes from './episodes.module.css';
import { episodesQuery } from './get-episodes';
import { episodeName, readEpisode, searchOf, sortingOf } from './place';
import { testShares } from './shares';
import { SharesChart } from './shares-chart';
import { TAG_NAMES, TAGS, type Tag } from './tags';

interface Props {
  run: RunDetail;
  search: RunSearch;
  onShow: (changes: RunSearch) => void;
}

export function EpisodesTab({ run, search, onShow }: Props) {
  const isLive = !hasEnded(run.state);
  const { data: metrics } = useQuery(metricsQuery(useQueryClient(), run.id, isLive));
  const tests = useMemo(() => (metrics ? testShares(metrics) : []), [metrics]);
  const place = readEpisode(search.episode);
  return (
    <>
      {tests.length > 0 && (
        <SharesChart tests={tests} chosen={search.test} onChoose={(test) => onShow({ test, episode: undefined })} />
      )}
      <Listed run={run} search={search} onShow={onShow} isLive={isLive} />
      {place && <EpisodeTimelines key={search.episode} runId={run.id} place={place} />}
    </>
  );
}

function Listed({ run, search, onShow, isLive }: Props & { isLive: boolean }) {
  const sorting = sortingOf(search);
  const wanted = { ...sorting, tag: search.tag, epoch: search.test };
  const { data, error, fetchNextPage, isFetchingNextPage, isFetchNextPageError } = useInfiniteQuery(
    episodesQuery(run.id, wanted, isLive),
  );
  if (error && !data) {
    return (
      <SentencePanel urgent title="The episodes cannot be listed">
        {sentence(error)}
      </SentencePanel>
    );
  }
  const first = data?.pages[0];
  if (data === undefined || first === undefined) return null;
  if (first.epochs.length === 0) {
    return (
      <SentencePanel title="No episodes yet">
        The first episodes of every test are kept and appear here after the first test. How many is the setting
        “Recorded episodes”.
      </SentencePanel>
    );
  }
  const episodes = episodesOf(data.pages);
  return (
    <>
      <div className={classes.filters}>
        <Narrow search={search} epochs={first.epochs} onShow={onShow} />
        <span className="faint number">{formatPlural(first.total, 'recorded episode')}</span>
      </div>
      {episodes.length === 0 ? (
        <SentencePanel title="No recorded episode matches these filters" />
      ) : (
        <EpisodeTable
          runId={run.id}
          episodes={episodes}
          sorting={sorting}
          chosen={search.episode}
          onSort={(next) => onShow(searchOf(next))}
          onChoose={(episode) => onShow({ episode: episode === search.episode ? undefined : episode })}
        />
      )}
      {first.total > episodes.length && (
        <Button
          variant="default"
          size="compact-sm"
          mt="xs"
          loading={isFetchingNextPage}
          onClick={() => fetchNextPage()}
        >
          Show more of {formatPlural(first.total, 'episode')}
        </Button>
      )}
      {isFetchNextPageError && (
        <p className="problem" role="alert">
          {sentence(error)}
        </p>
      )}
    </>
  );
}

/** All that is shown, each once: a test that ends between two answers moves the rows on. */
function episodesOf(pages: readonly EpisodeList[]): Episode[] {
  const episodes = pages.flatMap((page) => page.episodes);
  return [...new Map(episodes.map((episode) => [episodeName(episode), episode])).values()];
}

interface NarrowProps {
  search: RunSearch;
  epochs: readonly number[];
  onShow: Props['onShow'];
}

function Narrow({ search, epochs, onShow }: NarrowProps) {
  return (
    <>
      <Select
        size="xs"
        w={150}
        aria-label="How it ended"
        placeholder="Ended in any way"
        clearable
        value={search.tag ?? null}
        data={TAGS.map((tag) => ({ value: tag, label: TAG_NAMES[tag] }))}
        onChange={(tag) => onShow({ tag: (tag as Tag | null) ?? undefined })}
      />
      <Select
        size="xs"
        w={150}
        aria-label="Epoch of the test"
        placeholder="Of all tests"
        clearable
        searchable
        value={search.test === undefined ? null : String(search.test)}
        data={[...epochs].reverse().map((epoch) => ({ value: String(epoch), label: `epoch ${epoch}` }))}
        onChange={(epoch) => onShow({ test: epoch === null ? undefined : Number(epoch) })}
      />
    </>
  );
}

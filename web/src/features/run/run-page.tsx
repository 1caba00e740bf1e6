/** One run: how it does, what it looks like, what it was told, what it wrote. */
import { Tabs } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { getRouteApi } from '@tanstack/react-router';
import type { RunDetail } from '@/client/schema.gen';
import { ButtonLink } from '@/components/anchor-link';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { runQuery } from '@/lib/queries';
import { runTitle } from '@/lib/run-title';
import { ConfigTab } from './components/config-tab';
import { FilesTab } from './components/files-tab';
import { HistoryTab } from './components/history-tab';
import { LogTab } from './components/log-tab';
import { OverviewTab } from './components/overview-tab';
import { RerunTab } from './components/rerun-tab';
import classes from './components/run.module.css';
import { RunHeader } from './components/run-header';
import { VideosTab } from './components/videos-tab';
import { ViewerTab } from './components/viewer-tab';
import { EpisodesTab } from './episodes/episodes-tab';
import { DemonstrationsTab } from './inspector/demonstrations-tab';
import { type RunSearch, TABS, type Tab } from './search';

const route = getRouteApi('/runs/$runId');

const TAB_NAMES: Record<Tab, string> = {
  overview: 'Overview',
  '3d': '3D',
  episodes: 'Episodes',
  demonstrations: 'Demonstrations',
  rerun: 'Rerun',
  videos: 'Videos',
  config: 'Config',
  log: 'Log',
  history: 'History',
  files: 'Files',
};

export function RunPage() {
  const { runId } = route.useParams();
  const { data: run, error, dataUpdatedAt } = useQuery(runQuery(runId));
  if (run === undefined) {
    return error ? (
      <SentencePanel urgent title="This run cannot be shown" actions={<ButtonLink to="/">All runs</ButtonLink>}>
        {sentence(error)}
      </SentencePanel>
    ) : null;
  }
  return (
    // A new key per run: what was zoomed or watched belongs to one run only.
    <div key={runId}>
      <title>{`${runTitle(run)} · SLDR`}</title>
      <RunHeader run={run} updatedAt={dataUpdatedAt} />
      <RunTabs run={run} />
    </div>
  );
}

function RunTabs({ run }: { run: RunDetail }) {
  const search = route.useSearch();
  const navigate = route.useNavigate();
  const show = (changes: RunSearch): void => {
    // Another tab begins at its top; all else happens where the person looks.
    void navigate({ search: (old) => ({ ...old, ...changes }), replace: true, resetScroll: 'tab' in changes });
  };
  return (
    <Tabs
      value={search.tab ?? 'overview'}
      onChange={(tab) => show({ tab: tab === 'overview' ? undefined : (tab as Tab) })}
      keepMounted={false}
    >
      <Tabs.List mb="md" className={classes.tabs} aria-label="About this run">
        {TABS.filter((tab) => tab !== 'demonstrations' || run.phase === 'locomotion').map((tab) => (
          <Tabs.Tab key={tab} value={tab}>
            {TAB_NAMES[tab]}
          </Tabs.Tab>
        ))}
      </Tabs.List>
      <Tabs.Panel value="overview">
        <OverviewTab run={run} search={search} onShow={show} />
      </Tabs.Panel>
      <Tabs.Panel value="3d">
        <ViewerTab key={search.episode} run={run} episode={search.episode} />
      </Tabs.Panel>
      <Tabs.Panel value="rerun">
        <RerunTab run={run} />
      </Tabs.Panel>
      <Tabs.Panel value="videos">
        <VideosTab run={run} />
      </Tabs.Panel>
      <Tabs.Panel value="episodes">
        <EpisodesTab run={run} search={search} onShow={show} />
      </Tabs.Panel>
      {run.phase === 'locomotion' && (
        <Tabs.Panel value="demonstrations">
          <DemonstrationsTab run={run} />
        </Tabs.Panel>
      )}
      <Tabs.Panel value="config">
        <ConfigTab run={run} />
      </Tabs.Panel>
      <Tabs.Panel value="log">
        <LogTab run={run} />
      </Tabs.Panel>
      <Tabs.Panel value="history">
        <HistoryTab runId={run.id} />
      </Tabs.Panel>
      <Tabs.Panel value="files">
        <FilesTab runId={run.id} />
      </Tabs.Panel>
    </Tabs>
  );
}

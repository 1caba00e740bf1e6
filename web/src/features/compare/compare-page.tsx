/** Methods over seeds, compared: their curves, and their best models. */
import { Tabs } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { getRouteApi } from '@tanstack/react-router';
import { useCallback } from 'react';
import type { CurveComparison } from '@/client/schema.gen';
import { AnchorLink, ButtonLink } from '@/components/anchor-link';
import { Freshness } from '@/components/freshness';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatPlural } from '@/lib/format';
import { studyQuery } from '@/lib/studies';
import { curvesQuery } from './api/get-curves';
import { BestTab } from './components/best-tab';
import { CompareFilters } from './components/compare-filters';
import classes from './components/controls.module.css';
import { CurvesTab } from './components/curves-tab';
import { ExportMenu } from './components/export-menu';
import type { CompareSearch, Tab } from './search';

const route = getRouteApi('/compare');

/** As many columns as a table of settings is readable with. */
const MOST_EXAMPLES = 10;

type Changes = CompareSearch | ((old: CompareSearch) => CompareSearch);

export function ComparePage() {
  const search = route.useSearch();
  const navigate = route.useNavigate();
  const { data: comparison, error, dataUpdatedAt } = useQuery(curvesQuery(search));
  const onShow = useCallback(
    (changes: Changes): void => {
      void navigate({
        search: (old) => ({ ...old, ...(typeof changes === 'function' ? changes(old) : changes) }),
        replace: true,
        resetScroll: false,
      });
    },
    [navigate],
  );
  const tab: Tab = search.tab ?? 'curves';
  return (
    <>
      <title>Compare · SLDR</title>
      <div className="page-head">
        <h1>Compare</h1>
        <OnlySome search={search} />
        <span className="faint number">{comparison && formatPlural(comparison.runs, 'run')}</span>
        <Freshness updatedAt={dataUpdatedAt} />
        {comparison && comparison.panels.length > 0 && (
          <div className={classes.heads}>
            {comparison.groups.length > 1 && (
              <ButtonLink to="/compare/configs" search={{ runs: examples(comparison) }} variant="default" size="xs">
                What differs
              </ButtonLink>
            )}
            <ExportMenu search={search} />
          </div>
        )}
      </div>
      <CompareFilters search={search} onShow={onShow} />
      {error && !comparison && (
        <SentencePanel urgent title="The runs cannot be compared">
          {sentence(error)}
        </SentencePanel>
      )}
      {comparison && comparison.panels.length === 0 && <NothingToCompare />}
      {comparison && comparison.panels.length > 0 && (
        <Tabs
          value={tab}
          onChange={(next) => onShow({ tab: next === 'best' ? 'best' : undefined })}
          keepMounted={false}
        >
          <Tabs.List mb="sm">
            <Tabs.Tab value="curves">Curves</Tabs.Tab>
            <Tabs.Tab value="best">Best models</Tabs.Tab>
          </Tabs.List>
          <Tabs.Panel value="curves">
            <CurvesTab search={search} comparison={comparison} onShow={onShow} />
          </Tabs.Panel>
          <Tabs.Panel value="best">
            <BestTab search={search} onShow={onShow} />
          </Tabs.Panel>
        </Tabs>
      )}
    </>
  );
}

/** That only the runs of a study, or some by name, are compared, and the way to all others. */
function OnlySome({ search }: { search: CompareSearch }) {
  const { study, runs } = search;
  const { data } = useQuery({ ...studyQuery(study ?? ''), enabled: study !== undefined });
  if (study === undefined && runs === undefined) return null;
  return (
    <span>
      Only{' '}
      {study === undefined ? (
        'chosen runs'
      ) : (
        <AnchorLink to="/studies/$studyId" params={{ studyId: study }} fz="inherit">
          {data?.name ?? 'one study'}
        </AnchorLink>
      )}
      .{' '}
      <AnchorLink to="/compare" search={{ ...search, study: undefined, runs: undefined }} fz="inherit">
        Show all runs
      </AnchorLink>
    </span>
  );
}

/** A run of each group, to tell by what the groups differ. */
function examples({ groups, panels }: CurveComparison): string {
  const curves = panels.flatMap((panel) => panel.curves);
  return groups
    .flatMap(({ key }) => curves.find(({ group }) => group === key)?.members[0]?.run_id ?? [])
    .slice(0, MOST_EXAMPLES)
    .join(',');
}

function NothingToCompare() {
  return (
    <SentencePanel title="No run to compare" actions={<ButtonLink to="/launch">Launch runs</ButtonLink>}>
      Choose other tasks, methods or another phase above, or launch a task with two methods and three seeds each: bands
      need three.
    </SentencePanel>
  );
}

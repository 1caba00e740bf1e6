/** Best models: the paper's bar figure, and what one number a run says about the methods. */
import { SegmentedControl, useComputedColorScheme } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import type { BestModels } from '@/client/schema.gen';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { AXIS_NAMES } from '@/lib/axes';
import type { Emphasis } from '@/lib/curves';
import { formatPlural, formatShare } from '@/lib/format';
import { bestQuery } from '../api/get-best';
import { type CompareSearch, EFFORTS, type Effort, partsOf, REACHED, toggled, USUAL_REACHED } from '../search';
import { standingOut } from '../view';
import classes from './best.module.css';
import { BestBars } from './best-bars';
import controls from './controls.module.css';
import { EfficiencyTable } from './efficiency-table';
import { FigureCard } from './figure-card';
import { GroupLegend } from './group-legend';
import { ImprovementMatrix } from './improvement-matrix';
import { LeftOutNotes } from './left-out-notes';
import { OverallBars } from './overall-bars';
import { ProfileChart } from './profile-chart';
import { StatisticControls } from './statistic-controls';

interface Props {
  search: CompareSearch;
  onShow: (changes: CompareSearch | ((old: CompareSearch) => CompareSearch)) => void;
}

export function BestTab({ search, onShow }: Props) {
  const { data: best, error } = useQuery(bestQuery(search));
  return (
    <>
      <div className={controls.row}>
        <StatisticControls search={search} onShow={onShow} hasLevel />
      </div>
      {error && !best && (
        <SentencePanel urgent title="The best models cannot be compared">
          {sentence(error)}
        </SentencePanel>
      )}
      {!best && !error && <p className="faint">Computing intervals…</p>}
      {best?.scores.length === 0 && (
        <SentencePanel title="Nothing has been tested yet">
          The best models appear here after the first test of a run.
        </SentencePanel>
      )}
      {best && best.scores.length > 0 && <Figures best={best} search={search} onShow={onShow} />}
    </>
  );
}

function Figures({ best, search, onShow }: Props & { best: BestModels }) {
  const scheme = useComputedColorScheme('light');
  const [near, setNear] = useState<Emphasis | null>(null);
  const emphasis = standingOut(best.groups, near, search.pin);
  const onPick = ({ key }: Emphasis): void => onShow((old) => ({ pin: old.pin === key ? undefined : key }));
  const look = { groups: best.groups, scheme };
  const tables = partsOf(search.tables);
  const tableOf = (name: string) => ({
    table: best.tables.find((table) => table.name === name),
    isTable: tables.includes(name),
    onTable: (picked: string) => onShow((old) => ({ tables: toggled(old.tables, picked) })),
  });
  const interval = `${formatShare(best.level)} interval`;
  const shared = formatPlural(best.overall_tasks.length, 'task');
  return (
    <>
      <GroupLegend
        {...look}
        emphasis={emphasis}
        pin={search.pin}
        statistic={`${best.words.metric}: ${best.words.statistic}. Rings are seeds.`}
        onNear={setNear}
        onPick={onPick}
      />
      <div className={classes.figures}>
        <FigureCard
          title="Best test success"
          words={`${best.words.statistic}; intervals need three seeds`}
          {...tableOf('scores')}
        >
          <BestBars {...look} scores={best.scores} emphasis={emphasis} onNear={setNear} />
        </FigureCard>
        <FigureCard
          title="Over all tasks"
          words={`Interquartile mean of the best test success over the ${shared} that every method has, ${interval}`}
          {...tableOf('overall')}
        >
          <OverallBars {...look} overall={best.overall} />
        </FigureCard>
        <FigureCard
          title="Performance profile"
          words={`Share of runs above each success, over the same ${shared}, ${interval}`}
          {...tableOf('profiles')}
        >
          <ProfileChart {...look} profiles={best.profiles} emphasis={emphasis} onNear={setNear} onPick={onPick} />
        </FigureCard>
        <FigureCard
          title="Probability of improvement"
          words={`How probably a run of the row beats one of the column, ties half; ${interval}; bold where it leaves out 50 %`}
          {...tableOf('improvements')}
        >
          <ImprovementMatrix {...look} improvements={best.improvements} />
        </FigureCard>
        <FigureCard
          title="Efficiency"
          words="Until a test first reaches the success: median and quartiles over seeds, and how many reach it"
          controls={<EffortControls search={search} onShow={onShow} />}
          {...tableOf('efficiency')}
        >
          <EfficiencyTable
            groups={best.groups}
            efficiency={best.efficiency}
            effort={search.effort ?? 'env_steps'}
            reached={search.reached ?? USUAL_REACHED}
          />
        </FigureCard>
      </div>
      <LeftOutNotes comparison={best} />
    </>
  );
}

function EffortControls({ search, onShow }: Props) {
  return (
    <div className={controls.row} style={{ margin: 0 }}>
      <SegmentedControl
        size="xs"
        aria-label="Counted in"
        value={search.effort ?? 'env_steps'}
        onChange={(next) => onShow({ effort: next === 'env_steps' ? undefined : (next as Effort) })}
        data={EFFORTS.map((value) => ({ value, label: AXIS_NAMES[value] }))}
      />
      <SegmentedControl
        size="xs"
        aria-label="Success to reach"
        value={String(search.reached ?? USUAL_REACHED)}
        onChange={(next) => onShow({ reached: Number(next) === USUAL_REACHED ? undefined : Number(next) })}
        data={REACHED.map((value) => ({ value: String(value), label: formatShare(value) }))}
      />
    </div>
  );
}

/** The curves of the chosen runs, live: controls, legend, panels, and what is not shown. */
import { useComputedColorScheme } from '@mantine/core';
import { useCallback, useMemo, useState } from 'react';
import type { CurveComparison } from '@/client/schema.gen';
import { isShare } from '@/lib/axes';
import type { Emphasis } from '@/lib/curves';
import type { Range } from '@/lib/zoom';
import { type CompareSearch, partsOf, toggled } from '../search';
import { type PanelView, standingOut, windowOf } from '../view';
import { CurveControls } from './curve-controls';
import { GroupLegend } from './group-legend';
import { LeftOutNotes } from './left-out-notes';
import { PanelGrid } from './panel-grid';

interface Props {
  search: CompareSearch;
  comparison: CurveComparison;
  onShow: (changes: CompareSearch | ((old: CompareSearch) => CompareSearch)) => void;
}

export function CurvesTab({ search, comparison, onShow }: Props) {
  const { view, onNear, onPick } = usePanelView(search, comparison, onShow);
  const onTable = useCallback((task: string) => onShow((old) => ({ tables: toggled(old.tables, task) })), [onShow]);
  return (
    <>
      <CurveControls search={search} onShow={onShow} />
      <GroupLegend
        groups={comparison.groups}
        scheme={view.scheme}
        emphasis={view.emphasis}
        pin={search.pin}
        statistic={legendWords(comparison, view.weight)}
        onNear={onNear}
        onPick={onPick}
      />
      <PanelGrid panels={comparison.panels} view={view} tables={partsOf(search.tables)} onTable={onTable} />
      <LeftOutNotes comparison={comparison} />
    </>
  );
}

/** What line and band are; smoothing changes what is seen, so it is told too. */
function legendWords({ words }: CurveComparison, weight: number): string {
  const smoothed = weight > 0 ? `; smoothed by ${weight.toFixed(2)}, the computed line faint behind` : '';
  return `${words.metric}: ${words.statistic}${smoothed}. A cross marks where seeds have ended and others go on.`;
}

function usePanelView(search: CompareSearch, comparison: CurveComparison, onShow: Props['onShow']) {
  const scheme = useComputedColorScheme('light');
  const [near, setNear] = useState<Emphasis | null>(null);
  const isByRun = search.hover === 'run';
  const onNear = useCallback(
    (next: Emphasis | null) => {
      const wanted = next && (isByRun ? next : { key: next.key });
      setNear((old) => (old?.key === wanted?.key && old?.runId === wanted?.runId ? old : wanted));
    },
    [isByRun],
  );
  const onPick = useCallback(
    ({ key }: Emphasis) => onShow((old) => ({ pin: old.pin === key ? undefined : key })),
    [onShow],
  );
  const onZoom = useCallback((range: Range | null) => onShow({ from: range?.[0], to: range?.[1] }), [onShow]);
  const { from, to, logx, logy, smooth, pin } = search;
  const window = useMemo(() => windowOf({ from, to, logx }, comparison.panels), [from, to, logx, comparison.panels]);
  const view = useMemo(
    (): PanelView => ({
      groups: comparison.groups,
      metric: comparison.metric,
      metricName: comparison.words.metric,
      statistic: comparison.words.statistic,
      axis: comparison.x,
      scheme,
      weight: smooth ?? 0,
      isLogX: logx === 'yes',
      isLogY: logy === 'yes',
      isShare: isShare(comparison.metric),
      ...window,
      emphasis: standingOut(comparison.groups, near, pin),
      onZoom,
      onNear,
      onPick,
    }),
    [comparison, scheme, smooth, logx, logy, window, near, pin, onZoom, onNear, onPick],
  );
  return { view, onNear, onPick };
}

/** Performance profiles: which share of a method's runs gets beyond each success. */
import { useMemo, useState } from 'react';
import type { Group, Profile } from '@/client/schema.gen';
import { CurveChart } from '@/components/curve-chart';
import { type Curve, type Emphasis, rowAt } from '@/lib/curves';
import { formatShare } from '@/lib/format';
import { groupStyle, type Scheme } from '@/lib/palette';
import type { Range } from '@/lib/zoom';

interface Props {
  profiles: readonly Profile[];
  groups: readonly Group[];
  scheme: Scheme;
  emphasis: Emphasis | null;
  onNear: (emphasis: Emphasis | null) => void;
  onPick: (emphasis: Emphasis) => void;
}

const ALL: Range = [0, 1];
const SHARES: Range = [-0.02, 1.02];
const HEIGHT = 280;

export function ProfileChart({ profiles, groups, scheme, ...rest }: Props) {
  const [zoom, setZoom] = useState<Range | null>(null);
  const [place, setPlace] = useState<number | null>(null);
  const curves = useMemo(() => profileCurves(profiles, groups, scheme), [profiles, groups, scheme]);
  const wordsAt = (at: number): string =>
    `above ${formatShare(at)}: ${curves.map(({ label, x, centre }) => `${label} ${formatShare(centre[rowAt(x, at)])}`).join(', ')}`;
  return (
    <>
      <CurveChart
        {...rest}
        curves={curves}
        scheme={scheme}
        height={HEIGHT}
        isSmoothed={false}
        isLogX={false}
        isLogY={false}
        range={zoom ?? ALL}
        whole={ALL}
        yRange={SHARES}
        formatX={showShare}
        formatY={showShare}
        onPoint={setPlace}
        onZoom={setZoom}
        description="Share of runs over best test success"
        describePlace={wordsAt}
      />
      <p className="faint" style={{ margin: '2px 6px', fontSize: 12, minHeight: '1.5em' }}>
        {place === null ? 'Across: best test success. Up: share of runs above it.' : wordsAt(place)}
      </p>
    </>
  );
}

function profileCurves(profiles: readonly Profile[], groups: readonly Group[], scheme: Scheme): Curve[] {
  return profiles.flatMap(({ group: key, thresholds, share, low, high, n }): Curve[] => {
    const group = groups.find((other) => other.key === key);
    if (group === undefined) return [];
    return [
      {
        key,
        label: group.label,
        style: groupStyle(group, scheme),
        x: thresholds,
        centre: share,
        raw: share,
        low,
        high,
        n: thresholds.map(() => n),
        seeds: [],
        losses: [],
      },
    ];
  });
}

function showShare(value: number): string {
  return formatShare(value);
}

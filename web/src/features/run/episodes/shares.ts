/** How the episodes of each test ended, as shares that are stacked. */
import { formatShare } from '@/lib/format';
import type { Metrics } from '@/lib/metrics';
import { shareMetric, TAG_NAMES, TAGS, type Tag } from './tags';

/** One test. */
export interface TestShares {
  readonly epoch: number;
  readonly shares: Readonly<Record<Tag, number>>;
}

/** The tests that told how their episodes ended, oldest first. */
export function testShares(metrics: Metrics): TestShares[] {
  const columns = TAGS.map((tag) => metrics.values[shareMetric(tag)] ?? []);
  return metrics.epoch.flatMap((epoch, row) => {
    const values = columns.map((column) => column[row] ?? null);
    if (values.every((value) => value === null)) return [];
    return [
      { epoch, shares: Object.fromEntries(TAGS.map((tag, at) => [tag, values[at] ?? 0])) as Record<Tag, number> },
    ];
  });
}

/** A stretch of a stacked bar, from the bottom up. */
export interface Stretch {
  readonly tag: Tag;
  readonly from: number;
  readonly to: number;
}

/** The stretches of one bar; what did not happen has none. */
export function stacked({ shares }: TestShares): Stretch[] {
  let top = 0;
  return TAGS.flatMap((tag) => {
    const from = top;
    top += shares[tag];
    return shares[tag] > 0 ? [{ tag, from, to: top }] : [];
  });
}

/** One test in words. */
export function describeShares({ epoch, shares }: TestShares): string {
  const parts = TAGS.filter((tag) => shares[tag] > 0).map((tag) => `${TAG_NAMES[tag]} ${formatShare(shares[tag])}`);
  return `epoch ${epoch}: ${parts.join(', ')}`;
}

/** Which tests get a label below them: a few, on round numbers. */
export function labelled(tests: readonly TestShares[], most: number): ReadonlySet<number> {
  const span = (tests.at(-1)?.epoch ?? 0) - (tests[0]?.epoch ?? 0) + 1;
  const step = [1, 2, 5, 10, 20, 50, 100, 200, 500].find((size) => span / size <= most) ?? 1000;
  return new Set(tests.map(({ epoch }) => epoch).filter((epoch) => epoch % step === 0 || (step > 1 && epoch === 1)));
}

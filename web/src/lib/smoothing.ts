/** Smooth a curve without moving its start: an exponential mean, freed from the bias of starting at zero. */

/** The most that curves may be smoothed. */
export const MOST_SMOOTHING = 0.99;

/**
 * Smooth the values of a curve; gaps (null) stay gaps.
 * The past fades with the steps that lie between two points, so curves logged often and rarely are smoothed alike.
 * @param steps where each value was logged, ascending
 * @param weight how much of the past is kept over one step, from 0 (the raw curve) to below 1
 */
export function smooth(
  values: readonly (number | null)[],
  steps: readonly number[],
  weight: number,
): readonly (number | null)[] {
  if (weight <= 0) return values;
  let before = { mean: 0, missing: 1 };
  let here = before;
  let kept = weight;
  let last: number | null = null;
  return values.map((value, at) => {
    if (value === null || !Number.isFinite(value)) return null;
    const step = steps[at] ?? at;
    // Of points at one place only the last counts, as where the server brings seeds to common places.
    if (last === null || step > last) {
      kept = weight ** (last === null ? 1 : step - last);
      before = here;
      last = step;
    }
    here = { mean: kept * before.mean + (1 - kept) * value, missing: kept * before.missing };
    return here.mean / (1 - here.missing);
  });
}

/** How an episode ended, or what went wrong in it. */
import type { Episode } from '@/client/schema.gen';

export type Tag = Episode['tag'];

/** Every tag, as they are stacked: what went right first. */
export const TAGS = ['success', 'too_slow', 'overshot', 'dropped', 'never_touched', 'other'] as const satisfies Tag[];

export const TAG_NAMES: Record<Tag, string> = {
  success: 'success',
  too_slow: 'too slow',
  overshot: 'overshot',
  dropped: 'dropped',
  never_touched: 'never touched',
  other: 'other',
};

/** The rule behind each tag, in one sentence; an episode has the first that fits. */
export const TAG_MEANING: Record<Tag, string> = {
  success: 'The goal is reached at the last step.',
  too_slow: 'Over the last 10 steps the gap to the goal shrank by a tenth or more.',
  overshot: 'The goal was reached earlier, and is not at the end.',
  dropped: 'An object ends 3 cm or more below where it was, and the robot does not touch it.',
  never_touched: 'The robot touched no object, and none moved by more than 5 mm.',
  other: 'None of the rules for the other words fits.',
};

/** The metric that holds a tag's share among all episodes of a test. */
export function shareMetric(tag: Tag): string {
  return `episodes/${tag}_share`;
}

/** Of many lines, draw those in view and a few around them; the others are empty room. */
import { defaultRangeExtractor, type Virtualizer } from '@tanstack/react-virtual';
import { Fragment, type ReactNode } from 'react';

/** Lines drawn above and below what is in view. */
export const OVERSCAN = 12;

/** Lines to draw: those in view and, wherever it is, the one with the focus. */
export function withActive(active: number) {
  return (range: Parameters<typeof defaultRangeExtractor>[0]): number[] =>
    [...new Set([active, ...defaultRangeExtractor(range)])].filter((i) => i < range.count).sort((a, b) => a - b);
}

/** How high a line is [px]; where nothing is laid out, as in tests, what was expected. */
export function heightOf(expected: number) {
  return (line: Element): number => line.getBoundingClientRect().height || expected;
}

interface Props<Place extends Element | Window> {
  virtualizer: Virtualizer<Place, HTMLElement>;
  draw: (index: number) => ReactNode;
  /** Empty room of some height. */
  room: (height: number) => ReactNode;
}

/** @returns the lines in their order, with room for those that are not drawn */
export function VirtualLines<Place extends Element | Window>({ virtualizer, draw, room }: Props<Place>) {
  const items = virtualizer.getVirtualItems();
  const margin = virtualizer.options.scrollMargin;
  const end = items.at(-1)?.end ?? margin;
  return (
    <>
      {items.map((item, at) => {
        const gap = item.start - (items[at - 1]?.end ?? margin);
        return (
          <Fragment key={item.key}>
            {gap > 0 && room(gap)}
            {draw(item.index)}
          </Fragment>
        );
      })}
      {virtualizer.getTotalSize() + margin - end > 0 && room(virtualizer.getTotalSize() + margin - end)}
    </>
  );
}

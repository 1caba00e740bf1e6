/** The runs as cards, for narrow screens; they scroll with the page. */
import { useWindowVirtualizer } from '@tanstack/react-virtual';
import { useEffect, useLayoutEffect, useRef, useState } from 'react';
import { formatPlural } from '@/lib/format';
import { groupTitle } from '../group-words';
import { useLineKeys } from '../use-line-keys';
import type { TableProps } from '../use-table';
import { GroupWords } from './group-line';
import classes from './lines.module.css';
import { MoreLink } from './more-link';
import { RunCard } from './run-card';
import { SelectBox } from './select-box';
import { heightOf, OVERSCAN, VirtualLines, withActive } from './virtual-lines';

/** Of a card with figures [px]. */
const CARD_HEIGHT = 168;

/** Height of what covers the top of the page [px]. */
const BAR_HEIGHT = 60;

export function RunCards({ search, lines, table, onRange }: TableProps) {
  const list = useRef<HTMLUListElement>(null);
  const [top, setTop] = useState(0);
  useLayoutEffect(() => setTop(list.current?.offsetTop ?? 0), []);
  const keys = useLineKeys({
    count: lines.count,
    scrollTo: (index) => virtualizer.scrollToIndex(index, { align: 'auto' }),
    onExtend: table.extend,
    onEnter: table.enter,
    onClear: table.selection.clear,
  });
  const virtualizer = useWindowVirtualizer<HTMLElement>({
    count: lines.count,
    estimateSize: () => CARD_HEIGHT,
    measureElement: heightOf(CARD_HEIGHT),
    scrollMargin: top,
    scrollPaddingStart: BAR_HEIGHT,
    overscan: OVERSCAN / 2,
    rangeExtractor: withActive(keys.active),
  });
  const { startIndex: first = 0, endIndex: last = 0 } = virtualizer.range ?? {};
  useEffect(() => onRange({ first: Math.max(0, first - OVERSCAN), last: last + OVERSCAN }), [first, last, onRange]);

  const draw = (index: number) => {
    const line = lines.lineAt(index);
    const place = { ref: virtualizer.measureElement, 'data-index': index, 'data-line': index };
    const box = { isActive: index === keys.active, onFocus: () => keys.setActive(index) };
    if (line.kind === 'run') {
      const isSelected = table.selection.has(line.run.id);
      return (
        <li {...place} data-run={line.run.id}>
          <RunCard
            line={line}
            metrics={search.columns ?? []}
            isSelected={isSelected}
            findRun={lines.findRun}
            onTag={table.pickTag}
            box={{
              ...box,
              onSelect: (chosen, isRange) => table.selection.setLine(index, chosen, isRange),
            }}
          />
        </li>
      );
    }
    if (line.kind === 'group') {
      const { group } = line;
      const title = groupTitle(group, search.group ?? []);
      const selected = table.selectedIn(group);
      return (
        <li {...place}>
          <div className={`card ${classes.card}`}>
            <div className={classes.cardHead}>
              <SelectBox
                {...box}
                label={`Select the ${formatPlural(group.runs, 'run')} of ${title}`}
                isSelected={selected === group.runs}
                isPartly={selected > 0 && selected < group.runs}
                onSelect={(chosen) => table.selectGroup(group, chosen)}
              />
              <GroupWords
                group={group}
                title={title}
                isOpen={line.isOpen}
                spread={search.spread}
                onToggle={() => table.enter(index)}
              />
            </div>
          </div>
        </li>
      );
    }
    return (
      <li {...place}>
        <div className={`card ${classes.card}`}>
          {line.kind === 'more' ? (
            <MoreLink {...box} line={line} />
          ) : (
            <span className={classes.bone} aria-hidden="true" />
          )}
        </div>
      </li>
    );
  };
  return (
    <ul className={classes.cards} aria-label="Runs" ref={list} onKeyDown={keys.onKeyDown}>
      <VirtualLines
        virtualizer={virtualizer}
        draw={draw}
        room={(height) => <li aria-hidden="true" style={{ height }} />}
      />
    </ul>
  );
}

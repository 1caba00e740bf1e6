/** The runs as a dense table that scrolls by itself, however many they are. */
import { useVirtualizer } from '@tanstack/react-virtual';
import { useEffect, useRef } from 'react';
import { BUILT_INS, METRIC_WIDTH, shownColumns } from '../columns';
import { useLineKeys } from '../use-line-keys';
import type { TableProps } from '../use-table';
import { GroupLine } from './group-line';
import classes from './lines.module.css';
import { MoreLink } from './more-link';
import { RunLine } from './run-line';
import { TableHead } from './table-head';
import { heightOf, OVERSCAN, VirtualLines, withActive } from './virtual-lines';

/** Of a line without a note, and of the head [px]. */
const LINE_HEIGHT = 36;
const SELECT_WIDTH = 40; // [px]

export function RunsTable({ search, lines, table, onRange }: TableProps) {
  const frame = useRef<HTMLDivElement>(null);
  const columns = shownColumns(search.show);
  const metrics = search.columns ?? [];
  const span = columns.length + metrics.length;
  const keys = useLineKeys({
    count: lines.count,
    scrollTo: (index) => virtualizer.scrollToIndex(index, { align: 'auto' }),
    onExtend: table.extend,
    onEnter: table.enter,
    onClear: table.selection.clear,
  });
  const virtualizer = useVirtualizer<HTMLDivElement, HTMLElement>({
    count: lines.count,
    getScrollElement: () => frame.current,
    estimateSize: () => LINE_HEIGHT,
    measureElement: heightOf(LINE_HEIGHT),
    scrollMargin: LINE_HEIGHT,
    scrollPaddingStart: LINE_HEIGHT,
    overscan: OVERSCAN,
    rangeExtractor: withActive(keys.active),
  });
  const { startIndex: first = 0, endIndex: last = 0 } = virtualizer.range ?? {};
  useEffect(() => onRange({ first: Math.max(0, first - OVERSCAN), last: last + OVERSCAN }), [first, last, onRange]);

  const draw = (index: number) => {
    const line = lines.lineAt(index);
    const place = {
      index,
      measure: virtualizer.measureElement,
      isActive: index === keys.active,
      onFocus: () => keys.setActive(index),
    };
    if (line.kind === 'run') {
      return (
        <RunLine
          {...place}
          line={line}
          columns={columns}
          metrics={metrics}
          isSelected={table.selection.has(line.run.id)}
          findRun={lines.findRun}
          onSelect={(isSelected, isRange) => table.selection.setLine(index, isSelected, isRange)}
          onTag={table.pickTag}
        />
      );
    }
    if (line.kind === 'group') {
      return (
        <GroupLine
          {...place}
          group={line.group}
          by={search.group ?? []}
          spread={search.spread}
          span={span}
          isOpen={line.isOpen}
          selected={table.selectedIn(line.group)}
          onSelect={(isSelected) => table.selectGroup(line.group, isSelected)}
          onToggle={() => table.enter(index)}
        />
      );
    }
    return (
      <tbody ref={virtualizer.measureElement} data-index={index} data-line={index} className={classes.waiting}>
        <tr aria-rowindex={index + 2}>
          <td />
          <td colSpan={span}>
            {line.kind === 'more' ? (
              <MoreLink line={line} isActive={place.isActive} onFocus={place.onFocus} />
            ) : (
              <span className={classes.bone} aria-hidden="true" />
            )}
          </td>
        </tr>
      </tbody>
    );
  };
  const widths = [...columns.map((key) => BUILT_INS[key].width), ...metrics.map(() => METRIC_WIDTH)];
  return (
    // biome-ignore lint/a11y/noStaticElementInteractions: the keys are those of the boxes inside
    <div className={`card ${classes.frame}`} ref={frame} onKeyDown={keys.onKeyDown}>
      <table
        className={classes.table}
        aria-label="Runs"
        aria-rowcount={lines.count + 1}
        style={{ minWidth: widths.reduce((sum, width) => sum + width, SELECT_WIDTH) }}
      >
        <colgroup>
          <col style={{ width: SELECT_WIDTH }} />
          {[...columns, ...metrics].map((key, at) => (
            <col key={key} style={{ width: widths[at] }} />
          ))}
        </colgroup>
        <TableHead
          columns={columns}
          metrics={metrics}
          sorting={table.sorting}
          onSort={table.sort}
          allSelected={table.allSelected}
          onSelectAll={table.selectAll}
        />
        <VirtualLines virtualizer={virtualizer} draw={draw} room={(height) => <Room height={height} span={span} />} />
      </table>
    </div>
  );
}

function Room({ height, span }: { height: number; span: number }) {
  return (
    <tbody aria-hidden="true">
      <tr style={{ height }}>
        <td colSpan={span + 1} className={classes.room} />
      </tr>
    </tbody>
  );
}

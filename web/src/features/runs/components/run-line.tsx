/** One run as a line of the table, with what there is to say about it below. */
import { useNavigate } from '@tanstack/react-router';
import type { MouseEvent, Ref } from 'react';
import { runTitle } from '@/lib/run-title';
import type { BuiltIn } from '../columns';
import type { Line, Lines } from '../lines';
import { formatMetric, parseMetricColumn } from '../metric-columns';
import classes from './lines.module.css';
import { RunCell } from './run-cell';
import { hasNote, RunNote } from './run-note';
import { SelectBox } from './select-box';

interface Props {
  index: number;
  line: Extract<Line, { kind: 'run' }>;
  columns: readonly BuiltIn[];
  metrics: readonly string[];
  isSelected: boolean;
  isActive: boolean;
  measure: Ref<HTMLTableSectionElement>;
  findRun: Lines['findRun'];
  onSelect: (isSelected: boolean, isRange: boolean) => void;
  onFocus: () => void;
  onTag: (tag: string) => void;
}

export function RunLine(props: Props) {
  const { index, line, columns, metrics, isSelected } = props;
  const navigate = useNavigate();
  const { run } = line;
  const open = (event: MouseEvent<HTMLElement>): void => {
    const isText = window.getSelection()?.isCollapsed === false;
    if (isText || (event.target as HTMLElement).closest('a, button, label')) return;
    void navigate({ to: '/runs/$runId', params: { runId: run.id } });
  };
  return (
    // A mouse may use the whole row; the keyboard uses the box and the link in it.
    // biome-ignore lint/a11y/useKeyWithClickEvents: Enter on the box is the keyboard's way
    <tbody
      ref={props.measure}
      className={classes.run}
      onClick={open}
      data-index={index}
      data-line={index}
      data-run={run.id}
      data-in-group={line.isInGroup || undefined}
      data-selected={isSelected || undefined}
    >
      <tr aria-rowindex={index + 2}>
        <td>
          <SelectBox
            label={`Select ${runTitle(run)}`}
            isSelected={isSelected}
            isActive={props.isActive}
            onSelect={props.onSelect}
            onFocus={props.onFocus}
          />
        </td>
        {columns.map((column) => (
          <RunCell key={column} column={column} run={run} onTag={props.onTag} />
        ))}
        {metrics.map((text, at) => (
          <td key={text} data-number>
            {formatMetric(parseMetricColumn(text)?.name ?? '', line.values[at])}
          </td>
        ))}
      </tr>
      {hasNote(run) && (
        <tr className={classes.note}>
          <td />
          <td colSpan={columns.length + metrics.length}>
            <RunNote run={run} findRun={props.findRun} />
          </td>
        </tr>
      )}
    </tbody>
  );
}

/** A group of runs as a line of the table: what they share, how many, how they stand, and their spread. */
import type { Ref } from 'react';
import type { RunGroup, RunState } from '@/client/schema.gen';
import { Icon } from '@/components/icon';
import { formatPlural } from '@/lib/format';
import { USUAL_SPREAD } from '../api/list-groups';
import { formatSeeds, groupTitle } from '../group-words';
import { formatMetric, parseMetricColumn, statisticName } from '../metric-columns';
import type { GroupKey } from '../search';
import classes from './lines.module.css';
import { SelectBox } from './select-box';

interface Props {
  index: number;
  group: RunGroup;
  by: readonly GroupKey[];
  spread?: string;
  span: number;
  isOpen: boolean;
  selected: number;
  isActive: boolean;
  measure: Ref<HTMLTableSectionElement>;
  onSelect: (isSelected: boolean) => void;
  onFocus: () => void;
  onToggle: () => void;
}

export function GroupLine(props: Props) {
  const { index, group, isOpen, selected } = props;
  const title = groupTitle(group, props.by);
  return (
    <tbody
      ref={props.measure}
      className={classes.group}
      data-index={index}
      data-line={index}
      data-selected={selected === group.runs || undefined}
    >
      <tr aria-rowindex={index + 2}>
        <td>
          <SelectBox
            label={`Select the ${formatPlural(group.runs, 'run')} of ${title}`}
            isSelected={selected === group.runs}
            isPartly={selected > 0 && selected < group.runs}
            isActive={props.isActive}
            onSelect={props.onSelect}
            onFocus={props.onFocus}
          />
        </td>
        <td colSpan={props.span}>
          <GroupWords {...props} title={title} isOpen={isOpen} />
        </td>
      </tr>
    </tbody>
  );
}

type WordsProps = Pick<Props, 'group' | 'isOpen' | 'onToggle' | 'spread'> & { title: string };

/** Also the head of a group among cards. */
export function GroupWords({ group, title, isOpen, onToggle, spread }: WordsProps) {
  return (
    <span className={classes.groupWords}>
      <button type="button" className={classes.toggle} aria-expanded={isOpen} onClick={onToggle}>
        <Icon name={isOpen ? 'down' : 'arrow'} size={13} />
        {title}
      </button>
      <span className="number">{formatPlural(group.runs, 'run')}</span>
      <SpreadWords group={group} metric={spread ?? USUAL_SPREAD} />
      <States states={group.states} />
      <span className={`faint number ${classes.seeds}`} title={`Seeds ${group.seeds.join(', ')}`}>
        seeds {formatSeeds(group.seeds)}
      </span>
    </span>
  );
}

function States({ states }: { states: RunGroup['states'] }) {
  return (
    <span className={classes.states}>
      {(Object.entries(states) as [RunState, number][]).map(([state, count]) => (
        <span key={state} data-state={state} className={classes.stateCount}>
          <Icon name={state} size={12} />
          {count} {state}
        </span>
      ))}
    </span>
  );
}

function SpreadWords({ group: { spread, runs }, metric }: { group: RunGroup; metric: string }) {
  const column = parseMetricColumn(metric);
  if (column === null) return null;
  const shown = (value: number): string => formatMetric(column.name, value);
  return (
    <span className={classes.spread} title={`${column.name}, ${statisticName(column)}: median and quartiles`}>
      {spread === null ? (
        <span className="faint">nothing logged</span>
      ) : (
        <>
          <b className="number">{shown(spread.median)}</b>{' '}
          <span className="faint number">
            [{shown(spread.lower)}, {shown(spread.upper)}]{spread.n < runs && ` of ${spread.n}`}
          </span>
        </>
      )}
    </span>
  );
}

/** The recorded episodes as rows; a press on one shows what happened in it. */
import type { MouseEvent } from 'react';
import type { Episode } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { formatValue, NOTHING } from '@/lib/format';
import runClasses from '../components/run.module.css';
import classes from './episodes.module.css';
import { type EpisodeSort, type EpisodeSorting, episodeName, pressed } from './place';
import { TagBadge } from './tag-badge';

interface Column {
  readonly name: string;
  readonly sort?: EpisodeSort;
  readonly help?: string;
  readonly isNumber?: boolean;
}

const COLUMNS: readonly Column[] = [
  { name: 'Epoch', sort: 'epoch', isNumber: true, help: 'Epochs trained when the test was held.' },
  { name: 'Episode', isNumber: true, help: 'Its number in the test.' },
  { name: 'Ended', sort: 'success', help: 'What went wrong, or success; sorted by success.' },
  { name: 'Return', sort: 'return', isNumber: true, help: "Sum of the task's rewards." },
  { name: 'Worst q', sort: 'worst_q', isNumber: true, help: 'Least SLDR reward: where the robot departs most.' },
  { name: 'at step', isNumber: true },
  { name: 'Steps', isNumber: true },
  { name: 'Simulates again', help: 'Whether start and actions alone give the same states, to the last bit.' },
];

interface Props {
  runId: string;
  episodes: readonly Episode[];
  sorting: EpisodeSorting;
  /** `epoch.index` of the one that is looked at. */
  chosen?: string;
  onSort: (sorting: EpisodeSorting) => void;
  onChoose: (episode: string) => void;
}

export function EpisodeTable({ runId, episodes, sorting, chosen, onSort, onChoose }: Props) {
  return (
    <div className={`card ${runClasses.tableFrame} ${classes.list}`}>
      <table className={`${runClasses.table} ${classes.table}`} aria-label="Recorded episodes">
        <thead>
          <tr>
            {COLUMNS.map((column) => (
              <Head key={column.name} column={column} sorting={sorting} onSort={onSort} />
            ))}
            <th scope="col">
              <span className="hidden">3D</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {episodes.map((episode) => (
            <Row
              key={episodeName(episode)}
              runId={runId}
              episode={episode}
              isChosen={episodeName(episode) === chosen}
              onChoose={onChoose}
            />
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Head({ column, sorting, onSort }: { column: Column; sorting: EpisodeSorting; onSort: Props['onSort'] }) {
  const { name, sort, help, isNumber } = column;
  const isSorted = sort !== undefined && sort === sorting.sort;
  return (
    <th
      scope="col"
      title={help}
      data-number={isNumber || undefined}
      aria-sort={sort && (isSorted ? (sorting.descending ? 'descending' : 'ascending') : 'none')}
    >
      {sort === undefined ? (
        name
      ) : (
        <button
          type="button"
          className={classes.sort}
          data-sorted={isSorted || undefined}
          onClick={() => onSort(pressed(sorting, sort))}
        >
          {name}
          <span aria-hidden="true">{isSorted ? (sorting.descending ? ' ↓' : ' ↑') : ' ↕'}</span>
        </button>
      )}
    </th>
  );
}

interface RowProps {
  runId: string;
  episode: Episode;
  isChosen: boolean;
  onChoose: Props['onChoose'];
}

function Row({ runId, episode, isChosen, onChoose }: RowProps) {
  const name = episodeName(episode);
  const open = (event: MouseEvent<HTMLElement>): void => {
    if (!(event.target as HTMLElement).closest('a, button')) onChoose(name);
  };
  return (
    // A mouse may use the whole row; the keyboard uses the button in it.
    <tr onClick={open} data-chosen={isChosen || undefined}>
      <td data-number>{episode.epoch}</td>
      <th scope="row" data-number>
        <button
          type="button"
          className={classes.open}
          aria-pressed={isChosen}
          aria-label={`Episode ${name}`}
          onClick={() => onChoose(name)}
        >
          {episode.index}
        </button>
      </th>
      <td>
        <TagBadge tag={episode.tag} />
      </td>
      <td data-number>{formatValue(episode.task_return)}</td>
      <td data-number>{formatValue(episode.worst_q)}</td>
      <td data-number>{episode.worst_q_step ?? NOTHING}</td>
      <td data-number>{episode.length}</td>
      <td>{episode.resimulates ? 'to the same bits' : 'differently'}</td>
      <td>
        <AnchorLink
          from="/runs/$runId"
          to="/runs/$runId"
          params={{ runId }}
          search={(old) => ({ ...old, tab: '3d', episode: name })}
          fz="inherit"
          aria-label={`Watch episode ${name} in 3D`}
        >
          3D
        </AnchorLink>
      </td>
    </tr>
  );
}

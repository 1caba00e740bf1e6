/** Tasks by methods: how each cell stands. A cell opens the list of its runs. */
import type { StudyDetail } from '@/client/schema.gen';
import { columnsOf, type StudyCell } from '@/lib/studies';
import { MatrixCell } from './matrix-cell';
import classes from './study.module.css';

interface Props {
  study: StudyDetail;
  /** The cell whose runs are listed. */
  open: StudyCell | undefined;
  onOpen: (cell: StudyCell | undefined) => void;
}

export function Matrix({ study, open, onOpen }: Props) {
  const columns = columnsOf(study.spec);
  const cells = new Map(study.cells.map((cell) => [keyOf(cell), cell]));
  return (
    <section className={`card ${classes.frame}`} aria-label="Matrix" tabIndex={-1}>
      <table className={classes.matrix}>
        <caption className="hidden">Best test success by task and method, and how the runs stand</caption>
        <thead>
          <tr>
            <th scope="col">Task</th>
            {columns.map(({ method, variant }) => (
              <th key={`${method} ${variant}`} scope="col">
                {method}
                {variant && <span className={classes.variant}>{variant}</span>}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {study.spec.tasks.map((task) => (
            <tr key={task}>
              <th scope="row">{task}</th>
              {columns.map(({ method, variant }) => {
                const cell = cells.get(keyOf({ task, method, variant }));
                return (
                  <td key={`${method} ${variant}`}>
                    {cell && (
                      <MatrixCell
                        cell={cell}
                        seeds={study.spec.seeds.length}
                        isOpen={cell === open}
                        onToggle={() => onOpen(cell === open ? undefined : cell)}
                      />
                    )}
                  </td>
                );
              })}
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}

function keyOf({ task, method, variant }: Pick<StudyCell, 'task' | 'method' | 'variant'>): string {
  return JSON.stringify([task, method, variant]);
}

/** Every run of the study as a matrix: how many of each cell are new, reused or there already. */
import type { StudyPreview, StudySpec } from '@/client/schema.gen';
import { Icon, type IconName } from '@/components/icon';
import { columnsOf } from '@/lib/studies';
import { countStandings } from '@/lib/study-preview';
import classes from './builder.module.css';

type Places = StudyPreview['places'];
type Standing = Places[number]['standing'];

const STANDINGS: Record<Standing, { word: string; icon: IconName }> = {
  new: { word: 'new', icon: 'launch' },
  joined: { word: 'reused', icon: 'retry' },
  in_study: { word: 'there', icon: 'succeeded' },
};

export function PreviewMatrix({ spec, preview }: { spec: StudySpec; preview: StudyPreview }) {
  const columns = columnsOf(spec);
  return (
    <section aria-label="What will run">
      <h2 className={classes.legend}>What will run</h2>
      <div className={`card ${classes.frame}`}>
        <table className={classes.matrix}>
          <caption className="hidden">Runs by task and method</caption>
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
            {spec.tasks.map((task) => (
              <tr key={task}>
                <th scope="row">{task}</th>
                {columns.map(({ method, variant }) => (
                  <td key={`${method} ${variant}`}>
                    <Counts places={preview.places.filter((place) => isAt(place, { task, method, variant }))} />
                  </td>
                ))}
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

function Counts({ places }: { places: Places }) {
  const counts = countStandings(places);
  return (Object.keys(STANDINGS) as Standing[])
    .filter((standing) => counts[standing] > 0)
    .map((standing) => (
      <span key={standing} className={classes.count} data-standing={standing}>
        <Icon name={STANDINGS[standing].icon} size={12} />
        {counts[standing]} {STANDINGS[standing].word}
      </span>
    ));
}

function isAt(place: Places[number], cell: { task: string; method: string; variant: string }): boolean {
  return place.task === cell.task && place.method === cell.method && place.variant === cell.variant;
}

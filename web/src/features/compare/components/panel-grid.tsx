/** Small multiples: a panel a task, laid out by family as in the paper's figures. */
import type { Panel } from '@/client/schema.gen';
import { byFamily } from '../families';
import type { PanelView } from '../view';
import { PanelCard } from './panel-card';
import classes from './panels.module.css';

interface Props {
  panels: readonly Panel[];
  view: PanelView;
  /** Tasks that are shown as a table. */
  tables: readonly string[];
  onTable: (task: string) => void;
}

/** Heights of a panel's plot [px]: few panels may be large. */
const HEIGHT = 190;
const LARGE = 300;
const FEW = 2;

export function PanelGrid({ panels, view, tables, onTable }: Props) {
  const isFew = panels.length <= FEW;
  const height = isFew ? LARGE : HEIGHT;
  // Many panels are all of one width, so that their x axes can be compared.
  const fill = { '--fill': isFew ? 'auto-fit' : 'auto-fill' } as React.CSSProperties;
  return byFamily(panels).map(({ title, things }) => (
    <section key={title} className={classes.family} aria-label={title}>
      <h2>{title}</h2>
      <div className={classes.grid} style={fill}>
        {things.map((panel) => (
          <PanelCard
            key={panel.task}
            panel={panel}
            view={view}
            height={height}
            isTable={tables.includes(panel.task)}
            onTable={onTable}
          />
        ))}
      </div>
    </section>
  ));
}

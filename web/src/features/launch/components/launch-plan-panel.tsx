/** What this launch would queue and reuse, and the button that does it. */
import { Button } from '@mantine/core';
import type { LaunchPlan, PlannedRun } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { Icon } from '@/components/icon';
import { WaysIn } from '@/components/ways-in';
import { NOT_YOURS, useMay } from '@/lib/access';
import { formatPlural, formatShare } from '@/lib/format';
import { launchCommand, launchScript } from '@/lib/ways-in';
import type { LaunchForm } from '../use-launch-form';
import classes from './launch.module.css';

/** Longer plans are cut after this many rows. */
const MOST_ROWS = 12;

interface Props {
  form: LaunchForm;
  problems: readonly string[];
  /** Problems that are also shown at their fields, which may be out of sight. */
  fieldProblems: readonly string[];
  isLaunching: boolean;
}

export function LaunchPlanPanel({ form, problems, fieldProblems, isLaunching }: Props) {
  const { plan, isPlanning } = form;
  const isMine = useMay('operator');
  const added = plan?.runs.filter(isTrained).length;
  return (
    <aside className={`card ${classes.plan}`} aria-label="What will be queued">
      <h2 className={classes.planTitle}>What will be queued</h2>
      <div aria-live="polite" data-planning={isPlanning || undefined} className={classes.planBody}>
        {plan ? (
          <Plan plan={plan} task={form.chosen.task} />
        ) : (
          <p className="faint">{fieldProblems.length > 0 ? 'Mend the marked fields first:' : 'Looking…'}</p>
        )}
        {fieldProblems.map((problem) => (
          <p key={problem} className="problem">
            {problem}
          </p>
        ))}
        {problems.map((problem) => (
          <p key={problem} className="problem" role="alert">
            {problem}
          </p>
        ))}
      </div>
      <Button
        type="submit"
        fullWidth
        size="md"
        loading={isLaunching}
        disabled={!isMine || form.launch === null || plan === undefined || isPlanning || fieldProblems.length > 0}
      >
        {added === undefined ? 'Launch' : added === 0 ? 'Open what exists' : `Launch ${formatPlural(added, 'run')}`}
      </Button>
      {!isMine && <p className="faint">{NOT_YOURS}</p>}
      {form.launch && (
        <WaysIn
          command={launchCommand(form.launch, window.location.origin)}
          script={launchScript(form.launch, window.location.origin)}
        />
      )}
    </aside>
  );
}

function Plan({ plan, task }: { plan: LaunchPlan; task: string }) {
  const reused = plan.runs.filter((run) => run.reused_run_id !== null).length;
  const added = plan.runs.filter(isTrained).length;
  const shipped = plan.runs.length - reused - added;
  const rows = plan.runs.slice(0, MOST_ROWS);
  return (
    <>
      <p className={classes.planSum}>
        <b>{formatPlural(added, 'run')}</b> will be queued{reused > 0 && `, ${formatPlural(reused, 'run')} reused`}
        {shipped > 0 && `, ${formatPlural(shipped, 'model')} taken from the zoo`}.
      </p>
      <ol className={classes.planRows}>
        {rows.map((run, at) => (
          // biome-ignore lint/suspicious/noArrayIndexKey: two runs may be alike in all that is shown, and rows keep no state
          <li key={`${run.task} ${run.phase} ${run.seed} ${at}`}>
            <PlanRow run={run} task={task} isNeeded={plan.runs.some((other) => needs(other, run))} />
          </li>
        ))}
      </ol>
      {plan.runs.length > rows.length && <p className="faint">and {plan.runs.length - rows.length} more</p>}
    </>
  );
}

interface RowProps {
  run: PlannedRun;
  /** What is launched; locomotion models may be of other tasks. */
  task: string;
  isNeeded: boolean;
}

function PlanRow({ run, task, isNeeded }: RowProps) {
  return (
    <>
      <Icon name={isTrained(run) ? 'launch' : 'succeeded'} size={14} />
      <span>
        <b>{run.phase}</b>
        {run.task !== task && ` of ${run.task}`}, {run.method}, seed {run.seed}
        <span className={classes.planNote}>
          {run.reused_run_id !== null ? (
            <>
              {'reused: '}
              <AnchorLink to="/runs/$runId" params={{ runId: run.reused_run_id }} fz="inherit">
                see the run
              </AnchorLink>
            </>
          ) : run.zoo_success !== null ? (
            `from the zoo: ${formatShare(run.zoo_success, 1)} test success`
          ) : isNeeded ? (
            'added first: the robot learns from its model'
          ) : run.equal_run_id !== null ? (
            <>
              {'repeats '}
              <AnchorLink to="/runs/$runId" params={{ runId: run.equal_run_id }} fz="inherit">
                a run with the same settings and seed
              </AnchorLink>
            </>
          ) : (
            'new'
          )}
        </span>
      </span>
    </>
  );
}

/** Whether a worker will train it. */
function isTrained(run: PlannedRun): boolean {
  return run.reused_run_id === null && run.zoo_success === null;
}

function needs(run: PlannedRun, other: PlannedRun): boolean {
  return run !== other && run.phase === 'manipulation' && other.phase === 'locomotion';
}

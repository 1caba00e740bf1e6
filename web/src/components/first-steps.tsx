/** The way to the first trained policy in three steps, for whoever has no run yet; it can be put away for good. */
import { Button } from '@mantine/core';
import { useLocalStorage } from '@mantine/hooks';
import { ButtonLink } from '@/components/anchor-link';
import classes from './first-steps.module.css';

/** A choice that is known to learn in minutes. */
const FIRST_RUN = {
  task: 'FetchPush',
  phase: 'manipulation',
  method: 'her-sldr',
  preset: 'quick',
  seeds: '0',
} as const;

interface Props {
  /** Whether the form of a new run stands below. */
  isAtForm?: boolean;
}

export function FirstSteps({ isAtForm = false }: Props) {
  const [isAway, putAway] = useLocalStorage({
    key: 'sldr-first-steps-away',
    defaultValue: false,
    getInitialValueInEffect: false,
  });
  if (isAway) return null;
  return (
    <section className={`card ${classes.guide}`} aria-label="Your first run">
      <div className={classes.head}>
        <h2>Your first run, in three steps</h2>
        <Button variant="subtle" size="compact-sm" onClick={() => putAway(true)}>
          Do not show this again
        </Button>
      </div>
      <ol className={classes.steps}>
        <li>
          <b>Choose a task.</b> FetchPush is the quickest: a robot arm pushes a block to a target.
        </li>
        <li>
          <b>Choose a method.</b> her-sldr is the paper's. First the object learns to move itself (the locomotion run),
          then the robot learns from it (the manipulation run). A ready locomotion model spares the first.
        </li>
        <li>
          <b>Launch and watch.</b> The run's page shows success, curves and the robot in 3D while it learns. With the
          preset quick, FetchPush takes about six minutes on two cores.
        </li>
      </ol>
      {!isAtForm && (
        <ButtonLink to="/launch" search={FIRST_RUN} variant="light">
          Begin with FetchPush and her-sldr
        </ButtonLink>
      )}
    </section>
  );
}

/** What stands in place of the table when no run passes the filters. */
import { ButtonLink } from '@/components/anchor-link';
import { FirstSteps } from '@/components/first-steps';
import { OnlyFor } from '@/components/only-for';
import { OpenSample } from '@/components/open-sample';
import { SampleStudy } from '@/components/sample-study';
import { SentencePanel } from '@/components/sentence-panel';
import { isNarrowed, type RunsSearch } from '../search';
import classes from './runs.module.css';

export function NoRuns({ search }: { search: RunsSearch }) {
  if (isNarrowed(search)) {
    return (
      <SentencePanel
        title="No run matches these filters"
        actions={
          <ButtonLink to="/" search={{}} variant="default">
            Clear the filters
          </ButtonLink>
        }
      />
    );
  }
  if (search.deleted) {
    return (
      <SentencePanel
        title="No run is deleted"
        actions={
          <ButtonLink to="/" search={{}} variant="default">
            All other runs
          </ButtonLink>
        }
      >
        Deleted runs wait here and can be restored as they were.
      </SentencePanel>
    );
  }
  return (
    <>
      <SentencePanel
        title="Nothing has been trained yet"
        actions={
          <>
            <OnlyFor least="operator">
              <ButtonLink to="/launch" size="md" variant="default">
                Launch the first run
              </ButtonLink>
            </OnlyFor>
            <OpenSample />
            <SampleStudy />
          </>
        }
      >
        Here simulated robots learn to push, stack and turn objects, and you watch, compare and replay what they learn.
        An object first learns to move itself to its goal (locomotion); the robot is then rewarded for moving it that
        way (manipulation). Launch one run, or a whole study of methods and seeds that is over in about two minutes. The
        quick start, <code>docs/quick-start.md</code>, goes through it step by step.
      </SentencePanel>
      <div className={classes.after}>
        <OnlyFor least="operator">
          <FirstSteps />
        </OnlyFor>
      </div>
    </>
  );
}

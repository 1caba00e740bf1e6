/** What stands in place of the table when no run passes the filters. */
import { ButtonLink } from '@/components/anchor-link';
import { OpenSample } from '@/components/open-sample';
import { SampleStudy } from '@/components/sample-study';
import { SentencePanel } from '@/components/sentence-panel';
import { isNarrowed, type RunsSearch } from '../search';

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
    <SentencePanel
      title="Nothing has been trained yet"
      actions={
        <>
          <ButtonLink to="/launch" size="lg" variant="default">
            Launch the first run
          </ButtonLink>
          <OpenSample />
          <SampleStudy />
        </>
      }
    >
      Choose a task, a method and seeds. An object first learns to move itself to its goal (locomotion); the robot then
      learns from it (manipulation). With the preset “quick” you can watch both happen. Or see everything at once: a
      two-minute study trains FetchPush with two methods and three seeds.
    </SentencePanel>
  );
}

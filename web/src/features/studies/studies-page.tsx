/** All studies, live. */
import { useQuery } from '@tanstack/react-query';
import { getRouteApi } from '@tanstack/react-router';
import { AnchorLink, ButtonLink } from '@/components/anchor-link';
import { Freshness } from '@/components/freshness';
import { Icon } from '@/components/icon';
import { OnlyFor } from '@/components/only-for';
import { OpenSample } from '@/components/open-sample';
import { SampleStudy } from '@/components/sample-study';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { studiesQuery } from '@/lib/studies';
import classes from './components/studies.module.css';
import { StudyRow } from './components/study-row';
import { UploadStudy } from './components/upload-study';

const route = getRouteApi('/studies');

export function StudiesPage() {
  const isDeleted = route.useSearch().deleted === 'yes';
  const { data, error, dataUpdatedAt } = useQuery(studiesQuery(isDeleted));
  return (
    <>
      <title>Studies · SLDR</title>
      <div className="page-head">
        <h1>{isDeleted ? 'Deleted studies' : 'Studies'}</h1>
        <span className="faint number">{data && countStudies(data.studies.length)}</span>
        <Freshness updatedAt={dataUpdatedAt} />
        <span className={classes.ways}>
          <AnchorLink to="/studies" search={{ deleted: isDeleted ? undefined : 'yes' }} fz="sm">
            {isDeleted ? 'All other studies' : 'Deleted studies'}
          </AnchorLink>
          {!isDeleted && data && data.studies.length > 0 && <OpenSample isQuiet />}
          <OnlyFor least="operator">
            <UploadStudy />
            <ButtonLink to="/studies/new" leftSection={<Icon name="launch" size={14} />}>
              New study
            </ButtonLink>
          </OnlyFor>
        </span>
      </div>
      {error && !data && (
        <SentencePanel urgent title="The studies cannot be shown">
          {sentence(error)}
        </SentencePanel>
      )}
      {!error && !data && <p className="faint">Looking…</p>}
      {data?.studies.length === 0 && (isDeleted ? <NoneDeleted /> : <NoStudies />)}
      {data && data.studies.length > 0 && (
        <ul className={classes.studies} aria-label="Studies">
          {data.studies.map((study) => (
            <StudyRow key={study.id} study={study} />
          ))}
        </ul>
      )}
    </>
  );
}

function NoStudies() {
  return (
    <SentencePanel
      title="Nothing has been compared yet"
      actions={
        <>
          <OnlyFor least="operator">
            <ButtonLink to="/studies/new" size="lg" variant="default">
              Choose what to compare
            </ButtonLink>
          </OnlyFor>
          <OpenSample />
          <SampleStudy />
        </>
      }
    >
      A study trains every combination of the tasks, methods and seeds that you choose, and shows them side by side.
      Runs that exist already are taken in, so nothing is trained twice. The two-minute study trains FetchPush with two
      methods and three seeds.
    </SentencePanel>
  );
}

function NoneDeleted() {
  return <SentencePanel title="No study is deleted">Deleted studies wait here and can be restored.</SentencePanel>;
}

function countStudies(count: number): string {
  return count === 1 ? '1 study' : `${count} studies`;
}

/** One study: its matrix of tasks and methods, live, and what can be done with it. */
import { useQuery } from '@tanstack/react-query';
import { getRouteApi } from '@tanstack/react-router';
import type { StudyDetail } from '@/client/schema.gen';
import { ButtonLink } from '@/components/anchor-link';
import { SentencePanel } from '@/components/sentence-panel';
import { Refused, sentence } from '@/lib/api';
import { studyQuery } from '@/lib/studies';
import { CellRuns } from './components/cell-runs';
import { LocomotionRuns } from './components/locomotion-runs';
import { Matrix } from './components/matrix';
import { StudyHeader } from './components/study-header';

const route = getRouteApi('/studies/$studyId');

export function StudyPage() {
  const { studyId } = route.useParams();
  const { data, error, dataUpdatedAt } = useQuery(studyQuery(studyId));
  if (data) return <Study study={data} updatedAt={dataUpdatedAt} />;
  if (!error) return <p className="faint">Looking…</p>;
  const isUnknown = error instanceof Refused && error.status === 404;
  return (
    <SentencePanel
      urgent
      title={isUnknown ? 'There is no such study' : 'The study cannot be shown'}
      actions={
        <ButtonLink to="/studies" variant="default">
          All studies
        </ButtonLink>
      }
    >
      {sentence(error)}
    </SentencePanel>
  );
}

function Study({ study, updatedAt }: { study: StudyDetail; updatedAt: number }) {
  const search = route.useSearch();
  const navigate = route.useNavigate();
  const open = study.cells.find(
    (cell) => cell.task === search.task && cell.method === search.method && cell.variant === (search.variant ?? ''),
  );
  return (
    <>
      <title>{`${study.name} · SLDR`}</title>
      <StudyHeader study={study} updatedAt={updatedAt} />
      <Matrix
        study={study}
        open={open}
        onOpen={(cell) =>
          void navigate({
            search: { task: cell?.task, method: cell?.method, variant: cell?.variant || undefined },
            replace: true,
            resetScroll: false,
          })
        }
      />
      {open && <CellRuns cell={open} />}
      <LocomotionRuns runs={study.locomotion} />
    </>
  );
}

/** The button for whoever has nothing yet: a whole study that is over in about two minutes. */
import { Button } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useNavigate } from '@tanstack/react-router';
import { useMay } from '@/lib/access';
import { sentence } from '@/lib/api';
import { SAMPLE_TEMPLATE, templatesQuery } from '@/lib/studies';
import { useLaunchStudy } from '@/lib/use-launch-study';

export function SampleStudy() {
  const { data } = useQuery(templatesQuery);
  const launching = useLaunchStudy();
  const navigate = useNavigate();
  const isMine = useMay('operator');
  const template = data?.templates.find(({ name }) => name === SAMPLE_TEMPLATE);
  if (template === undefined || !isMine) return null;
  const launch = (): void =>
    launching.mutate(
      { name: template.title, note: template.summary, spec: template.spec },
      { onSuccess: ({ study_id }) => void navigate({ to: '/studies/$studyId', params: { studyId: study_id } }) },
    );
  return (
    <>
      <Button size="md" loading={launching.isPending} title={template.summary} onClick={launch}>
        Launch a two-minute study
      </Button>
      {launching.error && (
        <p className="problem" role="alert">
          {sentence(launching.error)}
        </p>
      )}
    </>
  );
}

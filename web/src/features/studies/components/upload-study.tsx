/** The button that takes in a study file from another installation, as `sldr import` does. */
import { Button, FileButton } from '@mantine/core';
import { useRouter } from '@tanstack/react-router';
import type { StudyImport } from '@/client/schema.gen';
import { ShareBar } from '@/components/share-bar';
import { useComplaint, useToast } from '@/components/toasts';
import { formatPlural, formatShare } from '@/lib/format';
import { useUploadStudy } from '../api/upload-study';
import classes from './studies.module.css';

export function UploadStudy() {
  const toast = useToast();
  const complain = useComplaint();
  const router = useRouter();
  const uploading = useUploadStudy();
  const take = (file: File | null): void => {
    if (!file) return;
    // It can take minutes. What became of it is told wherever one is by then; who has left is not called away.
    const { pathname } = router.state.location;
    const tell = ({ study_id, runs, already_there }: StudyImport): void => {
      toast({
        text: already_there ? 'This study was here already.' : `A study with ${formatPlural(runs, 'run')} is here.`,
      });
      if (router.state.location.pathname !== pathname) return;
      void router.navigate({ to: '/studies/$studyId', params: { studyId: study_id } });
    };
    uploading.mutateAsync(file).then(tell, complain);
  };
  if (uploading.isPending) return <Sending share={uploading.share} />;
  return (
    <FileButton accept=".zip,application/zip" onChange={take} inputProps={{ 'aria-label': 'Study file' }}>
      {(props) => (
        <Button {...props} variant="default" title="A .zip file that another installation has exported">
          Upload a study file
        </Button>
      )}
    </FileButton>
  );
}

function Sending({ share }: { share: number }) {
  // All of it is there, and the server looks at every file and number before it takes anything.
  const text = share < 1 ? `Sending, ${formatShare(share)}` : 'The server looks at it';
  return (
    <span className={classes.sending} role="status">
      <ShareBar share={share} state="running" label="Sent of the study file" />
      {text}
    </span>
  );
}

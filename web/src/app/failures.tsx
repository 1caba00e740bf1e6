/** What stands in place of a page that is not there, or that broke. */
import { Button } from '@mantine/core';
import { type ErrorComponentProps, useRouter } from '@tanstack/react-router';
import { ButtonLink } from '@/components/anchor-link';
import { SentencePanel } from '@/components/sentence-panel';
import { Refused, Unreachable } from '@/lib/api';

export function PageNotFound() {
  return (
    <SentencePanel title="There is no such page" actions={<ButtonLink to="/">All runs</ButtonLink>}>
      The address leads nowhere; every run is listed on the runs page.
    </SentencePanel>
  );
}

export function PageBroke({ error, reset }: ErrorComponentProps) {
  const router = useRouter();
  const again = (): void => {
    reset();
    void router.invalidate();
  };
  const known = error instanceof Refused || error instanceof Unreachable;
  return (
    <SentencePanel
      urgent
      title="This page cannot be shown"
      actions={
        <>
          <Button onClick={again}>Try again</Button>
          <ButtonLink to="/" variant="default">
            All runs
          </ButtonLink>
        </>
      }
    >
      {known ? error.message : 'The page met something it did not expect; your runs are not affected. Reload it.'}
    </SentencePanel>
  );
}

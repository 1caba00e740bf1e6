/** From the selected runs to their curves side by side, and to what their configs differ in. */
import { Button } from '@mantine/core';
import { useRouter } from '@tanstack/react-router';
import type { MouseEvent, ReactNode } from 'react';
import type { RunSummary } from '@/client/schema.gen';

/** More runs make an address that is longer than servers read. */
const MOST_COMPARED = 200;

export function BulkCompare({ runs }: { runs: readonly RunSummary[] }) {
  if (runs.length > MOST_COMPARED) return null;
  const ids = runs.map((run) => run.id).join(',');
  return (
    <>
      <PageLink href={`/compare?runs=${ids}`}>Compare</PageLink>
      {runs.length > 1 && <PageLink href={`/compare/configs?runs=${ids}`}>Differences</PageLink>}
    </>
  );
}

function PageLink({ href, children }: { href: string; children: ReactNode }) {
  const { history } = useRouter();
  const go = (event: MouseEvent): void => {
    if (event.metaKey || event.ctrlKey || event.shiftKey) return;
    event.preventDefault();
    history.push(href);
  };
  return (
    <Button component="a" href={href} variant="default" size="compact-sm" onClick={go}>
      {children}
    </Button>
  );
}

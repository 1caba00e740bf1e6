/** From the selected runs to their curves side by side, and to what their configs differ in. */
import { Button } from '@mantine/core';
import { useRouter } from '@tanstack/react-router';
import type { MouseEvent, ReactNode } from 'react';
import type { RunSummary } from '@/client/schema.gen';

/** More runs make an address that is longer than servers read. */
const MOST_COMPARED = 200;

/** As many configs as the server tells apart. */
const MOST_CONFIGS = 50;

export function BulkCompare({ runs }: { runs: readonly RunSummary[] }) {
  const ofRobot = runs.filter((run) => run.phase === 'manipulation');
  // The compare page shows one phase, that of the robot unless it is told otherwise.
  const [compared, phase] = ofRobot.length > 0 ? [ofRobot, ''] : [runs, '&phase=locomotion'];
  return (
    <>
      <PageLink
        href={`/compare?runs=${idsOf(compared)}${phase}`}
        title={compared.length < runs.length ? 'Compares the manipulation runs alone' : undefined}
        count={compared.length}
        most={MOST_COMPARED}
      >
        Compare
      </PageLink>
      {runs.length > 1 && (
        <PageLink href={`/compare/configs?runs=${idsOf(runs)}`} count={runs.length} most={MOST_CONFIGS}>
          Differences
        </PageLink>
      )}
    </>
  );
}

function idsOf(runs: readonly RunSummary[]): string {
  return runs.map((run) => run.id).join(',');
}

interface LinkProps {
  href: string;
  title?: string | undefined;
  /** How many runs are asked for, and how many the page takes. */
  count: number;
  most: number;
  children: ReactNode;
}

function PageLink({ href, title, count, most, children }: LinkProps) {
  const { history } = useRouter();
  if (count > most) {
    return (
      <Button disabled title={`It takes ${most} runs at most; choose fewer`} variant="default" size="compact-sm">
        {children}
      </Button>
    );
  }
  const go = (event: MouseEvent): void => {
    if (event.metaKey || event.ctrlKey || event.shiftKey) return;
    event.preventDefault();
    history.push(href);
  };
  return (
    <Button component="a" href={href} title={title} variant="default" size="compact-sm" onClick={go}>
      {children}
    </Button>
  );
}

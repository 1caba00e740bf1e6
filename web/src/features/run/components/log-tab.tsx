/** The run's log; it follows the end unless scrolled up. */
import { Button } from '@mantine/core';
import { useQuery, useQueryClient } from '@tanstack/react-query';
import { useEffect, useRef, useState } from 'react';
import type { RunDetail } from '@/client/schema.gen';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { hasEnded } from '@/lib/states';
import { logQuery } from '../api/get-log';
import classes from './run.module.css';

/** Nearer than this to the end counts as being at the end [px]. */
const NEAR_END = 40;

export function LogTab({ run }: { run: RunDetail }) {
  const queries = useQueryClient();
  const { data, error } = useQuery(logQuery(queries, run.id, !hasEnded(run.state)));
  const box = useRef<HTMLDivElement>(null);
  const [isFollowing, setFollowing] = useState(true);
  const text = data?.text ?? '';
  // biome-ignore lint/correctness/useExhaustiveDependencies: new text is what moves the end
  useEffect(() => {
    if (isFollowing && box.current) box.current.scrollTop = box.current.scrollHeight;
  }, [text, isFollowing]);
  if (error && data === undefined) {
    return (
      <SentencePanel urgent title="The log cannot be shown">
        {sentence(error)}
      </SentencePanel>
    );
  }
  if (text === '') return <SentencePanel title="Nothing has been written yet" />;
  return (
    <div className={classes.logFrame}>
      <div
        ref={box}
        className={`card ${classes.log}`}
        role="log"
        aria-label="Log"
        aria-live="off"
        // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
        tabIndex={0}
        onScroll={({ currentTarget: { scrollHeight, scrollTop, clientHeight } }) =>
          setFollowing(scrollHeight - scrollTop - clientHeight < NEAR_END)
        }
      >
        {text}
      </div>
      {!isFollowing && (
        <Button className={classes.toEnd} size="compact-sm" onClick={() => setFollowing(true)}>
          Follow the end
        </Button>
      )}
    </div>
  );
}

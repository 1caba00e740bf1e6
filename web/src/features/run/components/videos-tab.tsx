/** The run's videos: what was ordered, how far it is, and the player. */
import { NumberInput } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import type { RunDetail } from '@/client/schema.gen';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { healthQuery } from '@/lib/queries';
import { isOnItsWay, videosQuery } from '../api/videos';
import { isInset } from '../video-sizes';
import { MakeVideo } from './make-video';
import { VideoList } from './video-card';
import classes from './videos.module.css';

export function VideosTab({ run }: { run: RunDetail }) {
  const { data, error } = useQuery(videosQuery(run.id));
  const { data: health } = useQuery(healthQuery);
  // What the camera beside a 3D scene shows is found there.
  const videos = data?.videos.filter((video) => !isInset(video));
  const [seed, setSeed] = useState(0);
  const isWaiting = videos?.some(isOnItsWay) && health?.viewer_alive === false;
  return (
    <section aria-label="Videos">
      <div className={classes.head}>
        {run.has_policy && (
          <>
            <NumberInput
              size="xs"
              w={150}
              prefix="Start and goal "
              aria-label="Number of start and goal"
              min={0}
              max={9999}
              clampBehavior="strict"
              value={seed}
              onChange={(value) => setSeed(Number(value))}
            />
            <MakeVideo runId={run.id} number={seed} label="Film the newest policy" />
          </>
        )}
        <span className="faint">Videos of recorded episodes are ordered where the episodes are listed.</span>
      </div>
      {isWaiting && (
        <p className={classes.note} role="status">
          Videos are drawn by the 3D viewer, which is not running; start it with <code>sldr viewer</code>.
        </p>
      )}
      {error && !data && (
        <SentencePanel urgent title="The videos cannot be shown">
          {sentence(error)}
        </SentencePanel>
      )}
      {videos?.length === 0 && (
        <SentencePanel title="No videos yet">
          {run.has_policy
            ? 'Film the newest policy, or an episode that a test has recorded.'
            : 'Once the first test has left a policy, it can be filmed here.'}
        </SentencePanel>
      )}
      <VideoList videos={videos ?? []} />
    </section>
  );
}

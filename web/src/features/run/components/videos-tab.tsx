/** The run's videos: what was ordered, how far it is, and the player. */
import { Anchor, Button, Loader, NumberInput } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import type { RunDetail, Video } from '@/client/schema.gen';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { healthQuery } from '@/lib/queries';
import { isOnItsWay, useOrderVideo, videosQuery } from '../api/videos';
import { MakeVideo } from './make-video';
import classes from './videos.module.css';

export function VideosTab({ run }: { run: RunDetail }) {
  const { data, error } = useQuery(videosQuery(run.id));
  const { data: health } = useQuery(healthQuery);
  const [seed, setSeed] = useState(0);
  const isWaiting = data?.videos.some(isOnItsWay) && health?.viewer_alive === false;
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
      {data?.videos.length === 0 && (
        <SentencePanel title="No videos yet">
          {run.has_policy
            ? 'Film the newest policy, or an episode that a test has recorded.'
            : 'Once the first test has left a policy, it can be filmed here.'}
        </SentencePanel>
      )}
      <ul className={classes.videos}>
        {data?.videos.map((video) => (
          <li key={video.id} className={`card ${classes.video}`}>
            <VideoCard video={video} />
          </li>
        ))}
      </ul>
    </section>
  );
}

function VideoCard({ video }: { video: Video }) {
  const again = useOrderVideo(video.run_id);
  const format = video.name.endsWith('.webm') ? 'webm' : 'mp4';
  const title = videoTitle(video);
  const { epoch, number, width, height } = video;
  return (
    <>
      <div className={classes.frame} style={{ aspectRatio: `${width} / ${height}` }}>
        {video.url !== null && (
          <video src={video.url} controls loop muted playsInline preload="metadata" aria-label={title} />
        )}
        {isOnItsWay(video) && (
          <p role="status">
            <Loader size="xs" /> {video.state === 'queued' ? 'Waiting to be drawn' : 'Being drawn'}
          </p>
        )}
        {video.state === 'failed' && (
          <div role="alert">
            <p>{video.reason}</p>
            <Button size="xs" onClick={() => again.mutate({ epoch, number, width, height, format })}>
              Try again
            </Button>
          </div>
        )}
      </div>
      <div className={classes.caption}>
        <span>{title}</span>
        <span className="faint number">
          {width} × {height}, {format}
        </span>
        {video.url !== null && (
          <Anchor href={video.url} download={video.name} fz="inherit">
            Download
          </Anchor>
        )}
      </div>
    </>
  );
}

function videoTitle({ epoch, number }: Video): string {
  return epoch === null ? `Newest policy, start and goal ${number}` : `Epoch ${epoch}, episode ${number}`;
}

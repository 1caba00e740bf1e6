/** Videos with their state: waiting, being drawn, to be played, or why not. */
import { Anchor, Button, Loader } from '@mantine/core';
import type { Video } from '@/client/schema.gen';
import { OnlyFor } from '@/components/only-for';
import { useComplaint } from '@/components/toasts';
import { isOnItsWay, useOrderVideo } from '../api/videos';
import type { Format } from '../video-sizes';
import classes from './videos.module.css';

export function VideoList({ videos }: { videos: readonly Video[] }) {
  return (
    <ul className={classes.videos} aria-label="Videos">
      {videos.map((video) => (
        <li key={video.id} className={`card ${classes.video}`}>
          <VideoCard video={video} />
        </li>
      ))}
    </ul>
  );
}

function VideoCard({ video }: { video: Video }) {
  const format = formatOf(video);
  const title = videoTitle(video);
  const { width, height } = video;
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
            <OnlyFor least="operator">
              <TryAgain video={video} />
            </OnlyFor>
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

function TryAgain({ video }: { video: Video }) {
  const complain = useComplaint();
  const order = useOrderVideo(video.run_id);
  const { epoch, number, width, height } = video;
  const again = (): void =>
    order.mutate({ epoch, number, width, height, format: formatOf(video) }, { onError: complain });
  return (
    <Button size="xs" onClick={again} loading={order.isPending}>
      Try again
    </Button>
  );
}

function formatOf({ name }: Video): Format {
  return name.endsWith('.webm') ? 'webm' : 'mp4';
}

function videoTitle({ epoch, number }: Video): string {
  return epoch === null ? `Newest policy, start and goal ${number}` : `Epoch ${epoch}, episode ${number}`;
}

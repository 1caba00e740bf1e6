/** What MuJoCo's own camera sees of a recorded episode, at the step that the scene beside it shows. */
import { Button, Loader } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useEffect, useRef } from 'react';
import { useMay } from '@/lib/access';
import { sentence } from '@/lib/api';
import { isOnItsWay, useOrderVideo, videosQuery } from '../api/videos';
import { INSET, isInset, stepAtTime, timeOfStep } from '../video-sizes';
import classes from './videos.module.css';

interface Props {
  runId: string;
  epoch: number;
  number: number;
  /** The step that is shown now. */
  step: number;
}

export function CameraInset({ runId, epoch, number, step }: Props) {
  const { data } = useQuery(videosQuery(runId));
  const order = useOrderVideo(runId);
  const isMine = useMay('operator');
  const video = useRef<HTMLVideoElement>(null);
  const drawn = data?.videos.find((video) => video.epoch === epoch && video.number === number && isInset(video));
  const url = drawn?.url;
  // biome-ignore lint/correctness/useExhaustiveDependencies: another video begins at its own beginning
  useEffect(() => seek(video.current, step), [step, url]);
  if (url) {
    return (
      <figure className={`card ${classes.inset}`}>
        <div className={classes.frame} style={{ aspectRatio: `${INSET.width} / ${INSET.height}` }}>
          <video
            ref={video}
            src={url}
            muted
            playsInline
            preload="auto"
            aria-label={`Camera, step ${step}`}
            onLoadedMetadata={() => seek(video.current, step)}
          />
        </div>
      </figure>
    );
  }
  if (drawn && isOnItsWay(drawn)) {
    return (
      <p className={classes.beside} role="status">
        <Loader size="xs" /> What the camera sees is being drawn.
      </p>
    );
  }
  if (!isMine) return null;
  return (
    <p className={classes.beside}>
      <Button
        variant="default"
        size="compact-xs"
        loading={order.isPending}
        onClick={() => order.mutate({ epoch, number, format: 'mp4', ...INSET })}
      >
        Show what the camera sees
      </Button>
      {order.error && <span role="alert">{sentence(order.error)}</span>}
      {drawn?.state === 'failed' && <span role="alert">{drawn.reason}</span>}
    </p>
  );
}

function seek(video: HTMLVideoElement | null, step: number): void {
  if (video !== null && stepAtTime(video.currentTime) !== step) video.currentTime = timeOfStep(step);
}

/** Videos of one recorded episode, and asking for another. */
import { useQuery } from '@tanstack/react-query';
import { videosQuery } from '../api/videos';
import { isInset } from '../video-sizes';
import { MakeVideo } from './make-video';
import { VideoList } from './video-card';

export function EpisodeVideos({ runId, epoch, number }: { runId: string; epoch: number; number: number }) {
  const { data } = useQuery(videosQuery(runId));
  const videos = data?.videos.filter((video) => video.epoch === epoch && video.number === number && !isInset(video));
  return (
    <>
      <MakeVideo runId={runId} epoch={epoch} number={number} />
      <VideoList videos={videos ?? []} />
    </>
  );
}

/** Order a video of an episode: choose a size, and go. */
import { Button, NativeSelect } from '@mantine/core';
import { useState } from 'react';
import { useComplaint } from '@/components/toasts';
import { useMay } from '@/lib/access';
import { formatName } from '@/lib/format';
import { useOrderVideo } from '../api/videos';
import { FORMATS, type Format, SIZES, type SizeName } from '../video-sizes';
import classes from './videos.module.css';

interface Props {
  runId: string;
  /** The test whose episode is filmed; without one, the newest policy makes an episode. */
  epoch?: number;
  /** Which episode of the test; without a test, the seed of start and goal. */
  number?: number;
  label?: string;
}

export function MakeVideo({ runId, epoch, number = 0, label = 'Make a video' }: Props) {
  const complain = useComplaint();
  const order = useOrderVideo(runId);
  const isMine = useMay('operator');
  const [size, setSize] = useState<SizeName>('medium');
  const [format, setFormat] = useState<Format>('mp4');
  if (!isMine) return null;
  const make = (): void =>
    order.mutate({ epoch: epoch ?? null, number, format, ...SIZES[size] }, { onError: complain });
  return (
    <span className={classes.order}>
      <NativeSelect
        size="xs"
        aria-label="Size of the video"
        value={size}
        onChange={(event) => setSize(event.currentTarget.value as SizeName)}
        data={Object.entries(SIZES).map(([value, { width, height }]) => ({
          value,
          label: `${formatName(value)}, ${width} × ${height}`,
        }))}
      />
      <NativeSelect
        size="xs"
        aria-label="Form of the video"
        value={format}
        onChange={(event) => setFormat(event.currentTarget.value as Format)}
        data={[...FORMATS]}
      />
      <Button size="xs" onClick={make} loading={order.isPending}>
        {label}
      </Button>
    </span>
  );
}

/** A small picture of a run: the end of an episode of its newest policy, or its task until there is one. */
import { useState } from 'react';
import { Icon } from '@/components/icon';
import classes from './run-thumbnail.module.css';

interface Props {
  runId: string;
  /** When this changes, there may be a newer picture. */
  version: string | number;
  /** [px] */
  width?: number;
}

/** Width over height of the pictures. */
const ASPECT = 1.6;

export function RunThumbnail({ runId, version, width = 56 }: Props) {
  const [missing, setMissing] = useState<string>();
  const url = `/api/runs/${runId}/thumbnail?seen=${version}`;
  return (
    <span className={classes.thumbnail} style={{ width, height: Math.round(width / ASPECT) }}>
      {missing === url ? (
        <Icon name="cube" size={Math.round(width / 3)} />
      ) : (
        <img src={url} alt="" loading="lazy" decoding="async" onError={() => setMissing(url)} />
      )}
    </span>
  );
}

/** What a task looks like; a quiet placeholder until the picture has been rendered. */
import { useEffect, useState } from 'react';
import { Icon } from '@/components/icon';
import classes from './launch.module.css';

/** A missing picture is asked for again after this long [ms], this many times. */
const RETRY_MS = 4_000;
const MOST_TRIES = 30;

export function TaskPicture({ url }: { url: string }) {
  const [tries, setTries] = useState(0);
  const [isMissing, setMissing] = useState(false);
  useEffect(() => {
    if (!isMissing || tries >= MOST_TRIES) return;
    const timer = setTimeout(() => {
      setTries(tries + 1);
      setMissing(false);
    }, RETRY_MS);
    return () => clearTimeout(timer);
  }, [isMissing, tries]);
  const [isThere, setThere] = useState(false);
  return (
    <span className={classes.picture}>
      {!isThere && <Icon name="cube" size={36} />}
      {!isMissing && (
        <img
          src={tries === 0 ? url : `${url}?try=${tries}`}
          alt=""
          hidden={!isThere}
          onLoad={() => setThere(true)}
          onError={() => setMissing(true)}
        />
      )}
    </span>
  );
}

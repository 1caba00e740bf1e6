/** Collect many demonstrations, and how they did as a whole. */
import { Button, NativeSelect, NumberInput, Progress } from '@mantine/core';
import { useState } from 'react';
import { formatCount, formatShare, NOTHING } from '@/lib/format';
import type { Scene } from '@/lib/use-scene-control';
import type { About, FanState } from './answers';
import classes from './inspector.module.css';

interface Props {
  scene: Scene;
  fan: FanState | null;
  about: About;
}

/** Sizes to choose from, in blocks. */
const BLOCKS = [2, 4, 10, 20, 40, 80];

const MOST_SEEDS = 2 ** 31 - 1;

export function FanBar({ scene, fan, about }: Props) {
  const [size, setSize] = useState(about.block * 4);
  const [seed, setSeed] = useState(1);
  return (
    <section className={`card ${classes.panel}`} aria-label="Fan of demonstrations">
      <h2>Many demonstrations</h2>
      <div className={classes.row}>
        <NativeSelect
          size="xs"
          label="How many"
          value={String(size)}
          data={BLOCKS.map((blocks) => blocks * about.block)
            .filter((count) => count <= about.most)
            .map((count) => ({ value: String(count), label: formatCount(count) }))}
          onChange={(event) => setSize(Number(event.currentTarget.value))}
        />
        <NumberInput
          size="xs"
          label="Seed"
          w={90}
          min={0}
          max={MOST_SEEDS}
          allowDecimal={false}
          value={seed}
          onChange={(value) => setSeed(Number(value))}
        />
        {fan?.collecting ? (
          <Button className={classes.low} size="xs" variant="default" onClick={() => scene.tell({ do: 'stop-fan' })}>
            Stop
          </Button>
        ) : (
          <Button className={classes.low} size="xs" onClick={() => scene.tell({ do: 'fan', count: size, seed })}>
            Collect
          </Button>
        )}
      </div>
      {fan?.collecting && (
        <>
          <Progress size="sm" value={(100 * fan.done) / fan.count} aria-label="Demonstrations collected" mt={8} />
          <p className="faint" role="status">
            {formatCount(fan.done)} of {formatCount(fan.count)} collected
          </p>
        </>
      )}
      {fan !== null && fan.done > 0 && <Summary fan={fan} />}
      {fan === null && (
        <p className="faint">
          The model reached {formatShare(about.success_rate, 1)} of its {formatCount(about.test_episodes)} test goals.
          Collect a fan of demonstrations to see where it fails.
        </p>
      )}
    </section>
  );
}

function Summary({ fan }: { fan: FanState }) {
  const rate = fan.successes === null ? null : fan.successes / fan.done;
  return (
    <dl className={classes.figures}>
      <div>
        <dt>Success</dt>
        <dd className="number">
          <b>{formatShare(rate, 1)}</b>{' '}
          <span className="faint">
            {formatCount(fan.successes)} of {formatCount(fan.done)}
          </span>
        </dd>
      </div>
      <div>
        <dt>95 % interval (Wilson)</dt>
        <dd className="number">
          {formatShare(fan.low, 1)} to {formatShare(fan.high, 1)}
        </dd>
      </div>
      <div>
        <dt>Median time to goal</dt>
        <dd className="number">{fan.median_s === null ? NOTHING : `${fan.median_s.toFixed(2)}\u202fs`}</dd>
      </div>
    </dl>
  );
}

/** How the episodes of each test ended: one stacked bar for each test, over the training. */
import { useComputedColorScheme } from '@mantine/core';
import { useElementSize } from '@mantine/hooks';
import { type KeyboardEvent, useId, useState } from 'react';
import { formatShare } from '@/lib/format';
import classes from './episodes.module.css';
import { describeShares, labelled, stacked, type TestShares } from './shares';
import { TagSwatch } from './tag-badge';
import { TagPatterns, tagFill } from './tag-fill';
import { TAG_MEANING, TAG_NAMES, TAGS } from './tags';

const HEIGHT = 156; // [px]
const TOP = 7; // [px]
const LEFT = 44; // [px]
const BOTTOM = 20; // [px]
/** Room that a label below the bars takes [px]. */
const LABEL = 42;
/** Bars are not drawn wider than this [px]. */
const WIDEST = 46;

interface Props {
  tests: readonly TestShares[];
  /** Epoch of the test that is singled out. */
  chosen?: number;
  onChoose: (epoch: number | undefined) => void;
}

export function SharesChart({ tests, chosen, onChoose }: Props) {
  const [at, setAt] = useState<number | null>(null);
  const chosenAt = tests.findIndex(({ epoch }) => epoch === chosen);
  const shown = at ?? (chosenAt === -1 ? tests.length - 1 : chosenAt);
  const test = tests[shown];
  const press = (event: KeyboardEvent): void => {
    const last = tests.length - 1;
    const next = { ArrowLeft: shown - 1, ArrowRight: shown + 1, Home: 0, End: last }[event.key];
    if (next !== undefined) setAt(Math.min(last, Math.max(0, next)));
    else if (event.key === 'Enter' || event.key === ' ') onChoose(test?.epoch === chosen ? undefined : test?.epoch);
    else if (event.key === 'Escape') onChoose(undefined);
    else return;
    event.preventDefault();
  };
  return (
    <figure className={`card ${classes.shares}`} aria-label="How test episodes ended">
      <figcaption>
        <h3>How test episodes ended</h3>
        <span className="faint number">{test && `epoch ${test.epoch}`}</span>
        <Legend test={test} />
      </figcaption>
      <div
        role="slider"
        tabIndex={0}
        aria-label="How test episodes ended, by epoch"
        aria-description="Left and right arrow step through the tests, Enter lists the episodes of one, Escape those of all."
        aria-valuemin={0}
        aria-valuemax={Math.max(0, tests.length - 1)}
        aria-valuenow={Math.max(0, shown)}
        aria-valuetext={test ? describeShares(test) : 'no test yet'}
        onKeyDown={press}
        onBlur={() => setAt(null)}
        onMouseLeave={() => setAt(null)}
      >
        <Bars tests={tests} shown={shown} chosen={chosen} onPoint={setAt} onChoose={onChoose} />
      </div>
    </figure>
  );
}

function Legend({ test }: { test?: TestShares }) {
  return (
    <ul className={classes.legend}>
      {TAGS.map((tag) => (
        <li key={tag} title={TAG_MEANING[tag]}>
          <TagSwatch tag={tag} />
          {TAG_NAMES[tag]} <b className="number">{formatShare(test?.shares[tag])}</b>
        </li>
      ))}
    </ul>
  );
}

interface BarsProps extends Props {
  shown: number;
  onPoint: (at: number) => void;
}

function Bars({ tests, shown, chosen, onPoint, onChoose }: BarsProps) {
  const scheme = useComputedColorScheme('light');
  const { ref, width } = useElementSize();
  const id = useId();
  const slot = Math.min(WIDEST, Math.max(0, width - LEFT) / Math.max(1, tests.length));
  const bar = slot > 6 ? slot - 2 : slot;
  const labels = labelled(tests, Math.max(1, (width - LEFT) / LABEL));
  const y = (share: number): number => TOP + (HEIGHT - BOTTOM - TOP) * (1 - share);
  return (
    <div ref={ref}>
      <svg width={width} height={HEIGHT} className={classes.bars} aria-hidden="true">
        <TagPatterns id={id} scheme={scheme} />
        {[0, 0.5, 1].map((share) => (
          <g key={share}>
            <path d={`M${LEFT} ${y(share)}H${width}`} className={classes.rule} />
            <text x={LEFT - 6} y={y(share) + 4} textAnchor="end">
              {formatShare(share)}
            </text>
          </g>
        ))}
        {tests.map((test, at) => (
          // The keyboard's way is the slider around the bars.
          // biome-ignore lint/a11y/noStaticElementInteractions: it only adds the mouse to the slider
          <g
            key={test.epoch}
            transform={`translate(${LEFT + at * slot} 0)`}
            opacity={chosen === undefined || test.epoch === chosen ? 1 : 0.45}
            onMouseEnter={() => onPoint(at)}
            onClick={() => onChoose(test.epoch === chosen ? undefined : test.epoch)}
          >
            <rect width={slot} height={HEIGHT} fill="transparent" />
            {stacked(test).map(({ tag, from, to }) => (
              <rect key={tag} width={bar} y={y(to)} height={y(from) - y(to)} fill={tagFill(id, tag)} />
            ))}
            {at === shown && <rect width={bar} y={y(1)} height={y(0) - y(1)} className={classes.pointed} />}
            {labels.has(test.epoch) && (
              <text x={bar / 2} y={HEIGHT - 4} textAnchor="middle">
                {test.epoch}
              </text>
            )}
          </g>
        ))}
      </svg>
    </div>
  );
}

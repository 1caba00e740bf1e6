/** One of the paper's equations: read by eyes as written, by a screen reader as spoken. */
import { EQUATIONS, type EquationName, readEquation } from '@/lib/equations';
import classes from './equation-line.module.css';

const TAGS = { line: 'span', index: 'sub', raised: 'sup' } as const;

export function EquationLine({ name }: { name: EquationName }) {
  const { written, spoken, source } = EQUATIONS[name];
  return (
    <span className={classes.line}>
      <span role="img" aria-label={spoken} className={classes.equation}>
        {readEquation(written).map(({ text, level }, at) => {
          const Tag = TAGS[level];
          // biome-ignore lint/suspicious/noArrayIndexKey: the pieces of a fixed equation keep their places
          return <Tag key={at}>{text}</Tag>;
        })}
      </span>{' '}
      <span className={classes.source}>{source}</span>
    </span>
  );
}

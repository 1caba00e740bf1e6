/** The demonstrations that failed, the worst first; a click plays one again. */
import { Button } from '@mantine/core';
import { formatCount, formatPlural } from '@/lib/format';
import type { Scene } from '@/lib/use-scene-control';
import type { FailuresAnswer, FanState, InspectorState } from './answers';
import classes from './inspector.module.css';
import { useAnswer } from './use-answer';

interface Props {
  scene: Scene;
  fan: FanState;
  shown: InspectorState;
}

/** Centimetres in a metre, degrees in a radian. */
const GAPS: Readonly<Record<string, { scale: number; unit: string }>> = {
  distance: { scale: 100, unit: '\u202fcm' },
  angle: { scale: 180 / Math.PI, unit: '°' },
};

const ENDINGS = { missed: 'never reached it', left: 'reached it, then left' } as const;

export function FailuresPanel({ scene, fan, shown }: Props) {
  const listed = useAnswer<FailuresAnswer>(scene, { do: 'failures' }, fan.version);
  if (listed === undefined) return null;
  const { total, failures } = listed;
  return (
    <section className={`card ${classes.panel}`} aria-label="Failures">
      <h2>{total === 0 ? 'No failures' : formatPlural(total, 'failure')}</h2>
      {total === 0 ? (
        <p className="faint">All {formatCount(fan.done)} ended at their goals.</p>
      ) : (
        // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
        <section className={classes.list} tabIndex={0} aria-label="Failures, the worst first">
          <table>
            <thead>
              <tr>
                <th scope="col">Number</th>
                <th scope="col">Ended away by</th>
                <th scope="col">How</th>
                <th scope="col">
                  <span className="hidden">Replay</span>
                </th>
              </tr>
            </thead>
            <tbody>
              {failures.map(({ number, object, ending, gaps }) => (
                <tr
                  key={`${number} ${object}`}
                  data-shown={(shown.number === number && shown.origin === 'replayed') || undefined}
                >
                  <td className="number">
                    {number}
                    {object !== 'object' && ` (${object})`}
                  </td>
                  <td className="number">{Object.entries(gaps).map(formatGap).join(', ')}</td>
                  <td>{ENDINGS[ending]}</td>
                  <td>
                    <Button
                      size="compact-xs"
                      variant="default"
                      aria-label={`Replay number ${number}`}
                      onClick={() => scene.tell({ do: 'open', seed: fan.seed, number })}
                    >
                      Replay
                    </Button>
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
        </section>
      )}
      {failures.length < total && <p className="faint">The worst {formatCount(failures.length)} are listed.</p>}
    </section>
  );
}

function formatGap([name, value]: [string, number]): string {
  const { scale, unit } = GAPS[name] ?? { scale: 1, unit: '' };
  return `${(value * scale).toFixed(1)}${unit}`;
}

/** Choose one of a few things, each shown as a card. Real radio buttons, so the arrow keys work. */
import { type ReactNode, useId } from 'react';
import classes from './choice-cards.module.css';

export interface ChoiceCard {
  readonly value: string;
  readonly title: string;
  readonly summary?: ReactNode;
  readonly picture?: ReactNode;
  /** Why it cannot be chosen now. */
  readonly obstacle?: string;
  /** A button that tells more. */
  readonly help?: ReactNode;
}

interface Props {
  legend: string;
  cards: readonly ChoiceCard[];
  value: string;
  onChange: (value: string) => void;
  problem?: string;
  /** Least width of a card [px]. */
  width?: number;
}

export function ChoiceCards({ legend, cards, value, onChange, problem, width = 190 }: Props) {
  const id = useId();
  return (
    <fieldset className={classes.set} aria-describedby={problem ? `${id}-problem` : undefined}>
      <legend className={classes.legend}>{legend}</legend>
      <div className={classes.grid} style={{ '--card-width': `${width}px` } as React.CSSProperties}>
        {cards.map((card) => (
          <label key={card.value} className={classes.card} data-off={card.obstacle ? true : undefined}>
            <input
              type="radio"
              className={classes.input}
              name={id}
              value={card.value}
              checked={card.value === value}
              disabled={card.obstacle !== undefined}
              onChange={() => onChange(card.value)}
              aria-label={card.title}
              aria-describedby={`${id}-${card.value}`}
            />
            {card.picture}
            <span className={classes.text}>
              <span className={classes.title}>{card.title}</span>
              <span id={`${id}-${card.value}`} className={classes.summary}>
                {card.obstacle ?? card.summary}
              </span>
            </span>
            {card.help && <span className={classes.help}>{card.help}</span>}
          </label>
        ))}
      </div>
      {problem && (
        <p id={`${id}-problem`} className="problem" role="alert">
          {problem}
        </p>
      )}
    </fieldset>
  );
}

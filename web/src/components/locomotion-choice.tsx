/** Where the robot's runs take their locomotion models from. */
import { useState } from 'react';
import { ChoiceCards } from '@/components/choice-cards';

const CARDS = [
  {
    value: 'zoo',
    title: 'zoo',
    summary: 'Use the models that come with the product, and train those that it lacks. The robot starts at once.',
  },
  { value: 'train', title: 'train', summary: 'Train every model here first, or share one that was trained here.' },
];

interface Props {
  value: string;
  problem?: string | undefined;
  onChange: (locomotion: string) => void;
}

export function LocomotionChoice({ value, problem, onChange }: Props) {
  // Once named, runs stay among the choices: passing over another card must not lose them.
  const [named, setNamed] = useState<string>();
  if (value !== named && CARDS.every((card) => card.value !== value)) setNamed(value);
  return (
    <ChoiceCards
      legend="Locomotion models"
      width={260}
      value={value}
      problem={problem}
      onChange={onChange}
      cards={named === undefined ? CARDS : [...CARDS, runsNamed(named)]}
    />
  );
}

function runsNamed(value: string) {
  return { value, title: 'runs', summary: `Take the models of these locomotion runs: ${value}.` };
}

/** A priority to type or step, taken when the field is left or Enter is pressed. */
import { NumberInput } from '@mantine/core';
import { useEffect, useRef, useState } from 'react';

/** Priorities go from minus this to this. */
const HIGHEST = 100;

interface Props {
  value: number;
  label: string;
  onSet: (priority: number) => void;
  /** Whether to take the focus as soon as it is there. */
  isEager?: boolean;
}

export function PriorityField({ value, label, onSet, isEager = false }: Props) {
  const field = useRef<HTMLInputElement>(null);
  const [typed, setTyped] = useState<number | string>(value);
  useEffect(() => setTyped(value), [value]);
  useEffect(() => {
    if (isEager) field.current?.select();
  }, [isEager]);
  const take = (): void => {
    const priority = typeof typed === 'number' ? typed : value;
    setTyped(priority);
    if (priority !== value) onSet(priority);
  };
  return (
    <NumberInput
      ref={field}
      size="xs"
      w={72}
      min={-HIGHEST}
      max={HIGHEST}
      clampBehavior="strict"
      allowDecimal={false}
      aria-label={label}
      value={typed}
      onChange={setTyped}
      onBlur={take}
      onKeyDown={(event) => {
        if (event.key === 'Enter') take();
        if (event.key === 'Escape') setTyped(value);
      }}
    />
  );
}

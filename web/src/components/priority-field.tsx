/** A priority to type or step, taken when the field is left or Enter is pressed. */
import { NumberInput } from '@mantine/core';
import { useEffect, useRef, useState } from 'react';

/** Priorities go from minus this to this. */
const HIGHEST = 100;

interface Props {
  /** Null where several runs have different ones: the field is empty, and whatever is typed is given. */
  value: number | null;
  label: string;
  /** Give it; a promise that is broken if it is refused. */
  onSet: (priority: number) => Promise<unknown>;
  /** Whether to take the focus as soon as it is there. */
  isEager?: boolean;
}

export function PriorityField({ value, label, onSet, isEager = false }: Props) {
  const field = useRef<HTMLInputElement>(null);
  /** What was given and is not answered yet. */
  const given = useRef<number>(null);
  const [typed, setTyped] = useState<number | string | null>(null);
  // biome-ignore lint/correctness/useExhaustiveDependencies: what was typed gives way to what is known now
  useEffect(() => setTyped(null), [value]);
  useEffect(() => {
    if (!isEager) return;
    field.current?.focus({ preventScroll: true });
    field.current?.select();
  }, [isEager]);
  const take = (): void => {
    // What begins with a zero is handed on as it was typed.
    const wanted = typed === null || typed === '' ? null : Number(typed);
    if (wanted === null || !Number.isInteger(wanted) || wanted === value) setTyped(null);
    // Enter may be what takes the focus away as well.
    else if (wanted !== given.current) {
      given.current = wanted;
      onSet(wanted)
        .catch(() => setTyped(null))
        .finally(() => {
          given.current = null;
        });
    }
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
      value={typed ?? value ?? ''}
      onChange={setTyped}
      onBlur={take}
      onKeyDown={(event) => {
        if (event.key === 'Enter') take();
        if (event.key === 'Escape') setTyped(null);
      }}
    />
  );
}

/** The box that selects a line, and the place of the keyboard in it. */
import { useEffect, useRef } from 'react';
import classes from './lines.module.css';

interface Props {
  label: string;
  isSelected: boolean;
  /** Whether only some of the line's runs are selected. */
  isPartly?: boolean;
  /** Whether the Tab key leads here. */
  isActive: boolean;
  onSelect: (isSelected: boolean, isRange: boolean) => void;
  onFocus: () => void;
}

export function SelectBox({ label, isSelected, isPartly = false, isActive, onSelect, onFocus }: Props) {
  const box = useRef<HTMLInputElement>(null);
  useEffect(() => {
    if (box.current) box.current.indeterminate = isPartly;
  }, [isPartly]);
  return (
    <label className={classes.select}>
      <input
        ref={box}
        type="checkbox"
        data-line-box
        tabIndex={isActive ? 0 : -1}
        aria-label={label}
        checked={isSelected}
        onChange={(event) => onSelect(event.currentTarget.checked, (event.nativeEvent as MouseEvent).shiftKey === true)}
        onFocus={onFocus}
      />
    </label>
  );
}

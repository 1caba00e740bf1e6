/** The box that selects every run that passes the filters. */
import { useEffect, useRef } from 'react';
import classes from './lines.module.css';

interface Props {
  allSelected: 'all' | 'some' | 'none';
  onSelectAll: (isSelected: boolean) => void;
}

export function SelectAllBox({ allSelected, onSelectAll }: Props) {
  const box = useRef<HTMLInputElement>(null);
  useEffect(() => {
    if (box.current) box.current.indeterminate = allSelected === 'some';
  }, [allSelected]);
  return (
    <label className={classes.select}>
      <input
        ref={box}
        type="checkbox"
        aria-label="Select all runs of this table"
        checked={allSelected === 'all'}
        onChange={() => onSelectAll(allSelected !== 'all')}
      />
    </label>
  );
}

/** Tags as small chips; where something can be done with one, each is a button. */
import classes from './tag-chips.module.css';

interface Props {
  tags: readonly string[];
  /** Show the runs that have this tag. */
  onPick?: (tag: string) => void;
  className?: string;
}

export function TagChips({ tags, onPick, className = '' }: Props) {
  return (
    <span className={`${classes.chips} ${className}`} title={tags.join(', ')}>
      {tags.map((tag) =>
        onPick ? (
          <button key={tag} type="button" className={classes.chip} onClick={() => onPick(tag)}>
            <span className="hidden">Only runs tagged </span>
            {tag}
          </button>
        ) : (
          <span key={tag} className={classes.chip}>
            {tag}
          </span>
        ),
      )}
    </span>
  );
}

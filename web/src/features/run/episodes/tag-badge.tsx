/** A tag as a word beside its look. */
import { Tooltip, useComputedColorScheme } from '@mantine/core';
import { useId } from 'react';
import classes from './episodes.module.css';
import { TagPatterns, tagFill } from './tag-fill';
import { TAG_MEANING, TAG_NAMES, type Tag } from './tags';

export function TagBadge({ tag }: { tag: Tag }) {
  return (
    <Tooltip label={TAG_MEANING[tag]} openDelay={400} maw={320} multiline>
      <span className={classes.badge}>
        <TagSwatch tag={tag} />
        {TAG_NAMES[tag]}
      </span>
    </Tooltip>
  );
}

export function TagSwatch({ tag }: { tag: Tag }) {
  const scheme = useComputedColorScheme('light');
  const id = useId();
  return (
    <svg width="12" height="12" aria-hidden="true" className={classes.swatch}>
      <TagPatterns id={id} scheme={scheme} />
      <rect width="12" height="12" rx="2" fill={tagFill(id, tag)} />
    </svg>
  );
}

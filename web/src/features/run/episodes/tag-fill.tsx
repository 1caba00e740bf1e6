/** How a tag looks where it fills a surface: a colour, and a pattern for those who do not see it. */
import type { Scheme } from '@/lib/palette';
import { TAGS, type Tag } from './tags';

// Of the lines' colours: green for what went right, grey for what has no name.
const COLORS: Record<Scheme, Record<Tag, string>> = {
  light: {
    success: '#00805c',
    too_slow: '#2b8fc9',
    overshot: '#8a6d00',
    dropped: '#c25700',
    never_touched: '#a8508a',
    other: '#7b818c',
  },
  dark: {
    success: '#2fc79a',
    too_slow: '#62b0ea',
    overshot: '#e3cf4b',
    dropped: '#f29a4a',
    never_touched: '#e39cc8',
    other: '#8d95a1',
  },
};

export function tagColor(tag: Tag, scheme: Scheme): string {
  return COLORS[scheme][tag];
}

/** What is drawn over the colour, on squares of 8 px; nothing for what went right. */
const PATTERNS: Record<Tag, string | undefined> = {
  success: undefined,
  too_slow: 'M0 8L8 0M-2 2L2 -2M6 10L10 6',
  overshot: 'M0 0L8 8M-2 6L2 10M6 -2L10 2',
  dropped: 'M0 4H8',
  never_touched: 'M2 2h1M6 6h1',
  other: 'M4 0V8',
};

/** The patterns, to be put once into a drawing that fills with them. */
export function TagPatterns({ id, scheme }: { id: string; scheme: Scheme }) {
  const ink = scheme === 'dark' ? '#131519' : '#ffffff';
  return (
    <defs>
      {TAGS.map((tag) => (
        <pattern key={tag} id={`${id}-${tag}`} width="8" height="8" patternUnits="userSpaceOnUse">
          <rect width="8" height="8" fill={tagColor(tag, scheme)} />
          {PATTERNS[tag] && <path d={PATTERNS[tag]} stroke={ink} strokeWidth="1.6" strokeOpacity="0.75" fill="none" />}
        </pattern>
      ))}
    </defs>
  );
}

/** What fills a surface with a tag's look. */
export function tagFill(id: string, tag: Tag): string {
  return `url(#${id}-${tag})`;
}

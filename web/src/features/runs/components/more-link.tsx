/** The way to the runs of an open group that do not fit under it; the arrow keys stop here too. */
import { AnchorLink } from '@/components/anchor-link';
import { formatPlural } from '@/lib/format';
import type { Line } from '../lines';

interface Props {
  line: Extract<Line, { kind: 'more' }>;
  isActive: boolean;
  onFocus: () => void;
}

export function MoreLink({ line, isActive, onFocus }: Props) {
  return (
    <AnchorLink to="/" search={line.search} fz={12.5} data-line-box tabIndex={isActive ? 0 : -1} onFocus={onFocus}>
      Show all, {formatPlural(line.count, 'run')} more
    </AnchorLink>
  );
}

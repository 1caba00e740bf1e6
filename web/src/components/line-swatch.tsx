/** A short piece of a line, as it is drawn in the charts. */
import type { LineStyle } from '@/lib/palette';

export function LineSwatch({ style: { color, dash }, width = 22 }: { style: LineStyle; width?: number }) {
  return (
    <svg width={width} height="8" aria-hidden="true" style={{ flexShrink: 0 }}>
      <path d={`M0 4h${width}`} stroke={color} strokeWidth="2.4" strokeDasharray={dash.join(' ')} />
    </svg>
  );
}

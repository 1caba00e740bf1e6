import { renderHook } from '@testing-library/react';
import { expect, test } from 'vitest';
import { useGrowing } from '@/lib/use-growing';
import type { Range } from '@/lib/zoom';

test('a window only grows until something else is looked at', () => {
  const first: { range: Range | null; view: string } = { range: [0, 2], view: 'loss' };
  const { result, rerender } = renderHook(({ range, view }) => useGrowing(range, view), { initialProps: first });
  const known = result.current;
  rerender({ range: [0.5, 1], view: 'loss' });
  expect(result.current).toBe(known);
  rerender({ range: [-1, 1], view: 'loss' });
  expect(result.current).toEqual([-1, 2]);
  rerender({ range: null, view: 'loss' });
  expect(result.current).toEqual([-1, 2]);
  rerender({ range: [5, 6], view: 'speed' });
  expect(result.current).toEqual([5, 6]);
});

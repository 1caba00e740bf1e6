import { act, renderHook } from '@testing-library/react';
import { expect, test } from 'vitest';
import { useSelection } from './use-selection';

const ROWS = ['a', 'b', 'c', 'd'];

test('with Shift all rows in between are selected, upwards too', () => {
  const { result } = renderHook(() => useSelection(ROWS));
  act(() => result.current.set('d', true, false));
  act(() => result.current.set('b', true, true));
  expect(result.current.ids).toEqual(['b', 'c', 'd']);
});

test('with Shift rows are left out again', () => {
  const { result } = renderHook(() => useSelection(ROWS));
  act(() => result.current.selectAll(ROWS));
  act(() => result.current.set('a', false, false));
  act(() => result.current.set('c', false, true));
  expect(result.current.ids).toEqual(['d']);
});

test('a row that is gone is no longer selected', () => {
  const { result, rerender } = renderHook(({ rows }) => useSelection(rows), { initialProps: { rows: ROWS } });
  act(() => result.current.selectAll(['a', 'b']));
  rerender({ rows: ['b', 'c', 'd'] });
  expect(result.current.ids).toEqual(['b']);
});

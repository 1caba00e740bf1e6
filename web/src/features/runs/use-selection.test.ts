import { act, renderHook, waitFor } from '@testing-library/react';
import { expect, test } from 'vitest';
import { RUN } from '@/testing/samples';
import type { Range, SomeRuns } from './lines';
import { useSelection } from './use-selection';

const ROWS = ['a', 'b', 'c', 'd'].map((id) => ({ ...RUN, id }));
const between = ({ first, last }: Range): SomeRuns => ROWS.slice(first, last + 1);

function selection(runsBetween: typeof between = between, onProblem: (error: unknown) => void = () => {}) {
  const { result } = renderHook(() => useSelection(runsBetween, onProblem));
  const set = (index: number, isSelected: boolean, isRange: boolean): Promise<void> =>
    act(async () => result.current.setLine(index, isSelected, isRange));
  return { result, set, ids: () => result.current.runs.map((run) => run.id).sort() };
}

test('with Shift all rows in between are selected, upwards too', async () => {
  const { set, ids } = selection();
  await set(3, true, false);
  await set(1, true, true);
  expect(ids()).toEqual(['b', 'c', 'd']);
});

test('with Shift rows are left out again', async () => {
  const { result, set, ids } = selection();
  act(() => result.current.set(ROWS, true));
  await set(0, false, false);
  await set(2, false, true);
  expect(ids()).toEqual(['d']);
});

test('after clearing, Shift begins anew', async () => {
  const { result, set, ids } = selection();
  await set(0, true, false);
  act(() => result.current.clear());
  await set(2, true, true);
  expect(ids()).toEqual(['c']);
});

test('rows that cannot be fetched are told of, and none is selected', async () => {
  const problems: unknown[] = [];
  const { set, ids } = selection(
    () => Promise.reject(new Error('away')),
    (error) => problems.push(error),
  );
  await set(1, true, false);
  await waitFor(() => expect(problems).toEqual([new Error('away')]));
  expect(ids()).toEqual([]);
});

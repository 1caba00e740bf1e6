import { act, renderHook, waitFor } from '@testing-library/react';
import { expect, test } from 'vitest';
import { RUN } from '@/testing/samples';
import { LOADING, type Range, type SomeRuns } from './lines';
import { useSelection } from './use-selection';

const ROWS = ['a', 'b', 'c', 'd'].map((id) => ({ ...RUN, id }));

/** Lines of runs, all at hand unless `runsBetween` says otherwise. */
function linesOf(rows: typeof ROWS, runsBetween?: () => SomeRuns) {
  const between = ({ first, last }: Range): SomeRuns => rows.slice(first, last + 1);
  return {
    runsBetween: runsBetween ?? between,
    lineAt: (index: number) => {
      const run = rows[index];
      return run === undefined ? LOADING : ({ kind: 'run', run, values: [], isInGroup: false } as const);
    },
    indexOf: (id: string) => rows.findIndex((run) => run.id === id),
  };
}

function selection(runsBetween?: () => SomeRuns, onProblem: (error: unknown) => void = () => {}) {
  const { result, rerender } = renderHook((rows) => useSelection(linesOf(rows, runsBetween), onProblem), {
    initialProps: ROWS,
  });
  const set = (index: number, isSelected: boolean, isRange: boolean): Promise<void> =>
    act(async () => result.current.setLine(index, isSelected, isRange));
  return { result, rerender, set, ids: () => result.current.runs.map((run) => run.id).sort() };
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

test('with Shift the range begins at the run that was chosen, wherever it stands by now', async () => {
  const { rerender, set, ids } = selection();
  await set(0, true, false);
  rerender([...ROWS.slice(1), ...ROWS.slice(0, 1)]);
  await set(2, true, true);
  expect(ids()).toEqual(['a', 'd']);
});

test('rows that were asked for before clearing stay unselected', async () => {
  let answer: (rows: typeof ROWS) => void = () => {};
  const rows = new Promise<typeof ROWS>((resolve) => {
    answer = resolve;
  });
  const { result, ids } = selection();
  act(() => result.current.set(rows, true));
  act(() => result.current.clear());
  await act(async () => answer(ROWS));
  expect(ids()).toEqual([]);
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

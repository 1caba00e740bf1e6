import { render, screen } from '@testing-library/react';
import { expect, test } from 'vitest';
import type { RunSummary } from '@/client/schema.gen';
import { RUN } from '@/testing/samples';
import type { BuiltIn } from '../columns';
import { RunCell } from './run-cell';

function cell(column: BuiltIn, run: RunSummary) {
  render(
    <table>
      <tbody>
        <tr>
          <RunCell column={column} run={run} onTag={() => {}} />
        </tr>
      </tbody>
    </table>,
  );
  return screen.getByRole('cell');
}

const SWEPT = { ...RUN, changes: ['agent.learning_rate=0.0003', 'loop.epochs=12'] };

test('a run of a sweep says beside its method in how many settings it is not as its preset', () => {
  expect(cell('method', SWEPT).textContent).toBe('her-sldr ±2 with agent.learning_rate=0.0003, loop.epochs=12');
});

test('a run as its preset has it says nothing more', () => {
  expect(cell('method', RUN).textContent).toBe('her-sldr');
});

test('the changes have a column of their own', () => {
  const changes = cell('changes', SWEPT);
  expect(changes.textContent).toBe('learning_rate=0.0003 epochs=12');
  expect(changes.querySelector('span')?.title).toBe(SWEPT.changes.join('\n'));
});

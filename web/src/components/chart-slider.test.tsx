import { render, screen } from '@testing-library/react';
import userEvent from '@testing-library/user-event';
import { createRef } from 'react';
import { expect, test } from 'vitest';
import { ChartSlider } from './chart-slider';

function slider(x: readonly number[]) {
  const place = { range: [0, 40], whole: [0, 40], onZoom: () => {}, description: 'Loss' } as const;
  const refs = { canvas: createRef<HTMLDivElement>(), plot: { current: null } };
  return <ChartSlider {...place} {...refs} x={x} describePoint={(at) => `epoch ${x[at]}`} />;
}

test('the cursor stays where it is while a live curve gets points', async () => {
  const user = userEvent.setup();
  const { rerender } = render(slider([10, 20, 30]));
  const chart = screen.getByRole('slider', { name: 'Loss' });
  chart.focus();
  await user.keyboard('{Home}{ArrowRight}');
  expect(chart.getAttribute('aria-valuetext')).toBe('epoch 20');
  rerender(slider([10, 15, 20, 30, 40]));
  expect(chart.getAttribute('aria-valuetext')).toBe('epoch 20');
  expect(chart.getAttribute('aria-valuenow')).toBe('2');
});

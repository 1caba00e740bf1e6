import { expect, test } from 'vitest';
import { formatPlace, formatX, xSteps } from './axes';

test('a place is short, and as exact as the distance of the ticks asks for', () => {
  expect(formatX('env_steps', 1_052_000)).toBe('1.05M');
  expect([1_050_000, 1_052_000, 1_054_000].map((value) => formatX('env_steps', value, 2000))).toEqual([
    '1.05M',
    '1.052M',
    '1.054M',
  ]);
  expect(formatX('updates', 400_000, 200_000)).toBe('400k');
  expect(formatX('wall_seconds', 7510)).toBe('2h 5m');
  expect(formatX('wall_seconds', 7510, 10)).toBe('2h 5m 10s');
  expect(formatX('epoch', 1.5, 0.5)).toBe('1.5');
});

test('in a table a count is written to its last digit', () => {
  expect(formatPlace('env_steps', 1_052_000)).toBe('1\u202f052\u202f000');
  expect(formatPlace('epoch', 3)).toBe('3');
});

test('the wall time of weeks has ticks too', () => {
  const fortnight = 14 * 86_400;
  expect(xSteps('wall_seconds')?.some((step) => fortnight / step >= 2 && fortnight / step <= 4)).toBe(true);
});

test('ticks that lie an epoch or more apart lie on whole ones', () => {
  const steps = xSteps('epoch') ?? [];
  expect(steps.filter((step) => step >= 1).every(Number.isInteger)).toBe(true);
  expect(steps.some((step) => 5000 / step >= 1 && 5000 / step <= 5)).toBe(true);
});

import { expect, test } from 'vitest';
import {
  formatAgo,
  formatCount,
  formatDuration,
  formatEstimate,
  formatMoment,
  formatName,
  formatPlural,
  formatRate,
  formatShare,
  formatShort,
  formatSize,
  formatUntil,
  formatValue,
  NOTHING,
  secondsBetween,
} from '@/lib/format';

test('what is missing is a dash everywhere', () => {
  for (const format of [
    formatCount,
    formatShort,
    formatValue,
    formatShare,
    formatRate,
    formatDuration,
    formatEstimate,
    formatAgo,
    formatUntil,
  ]) {
    expect(format(null)).toBe(NOTHING);
    expect(format(undefined)).toBe(NOTHING);
    expect(format(Number.NaN)).toBe(NOTHING);
  }
});

test('counts are grouped by thousands', () => {
  expect(formatCount(57000)).toBe('57\u202f000');
  expect(formatCount(999)).toBe('999');
});

test.each([
  [0, '0'],
  [88.24, '88.2'],
  [999.6, '1k'],
  [3123, '3.12k'],
  [999_600, '1M'],
  [1_234_567, '1.23M'],
  [-4200, '-4.2k'],
])('%d is %s in short', (value, text) => {
  expect(formatShort(value)).toBe(text);
});

test.each([
  [0.00012345, '1.23e-4'],
  [0.046561, '0.04656'],
  [12.98765, '12.99'],
  [2_500_000, '2.50e6'],
  [0, '0'],
])('%d is shown as %s', (value, text) => {
  expect(formatValue(value)).toBe(text);
});

test('shares are percent', () => {
  expect(formatShare(0.934)).toBe('93\u202f%');
  expect(formatShare(0.934, 1)).toBe('93.4\u202f%');
});

test.each([
  [7.4, '7s'],
  [59.6, '1m'],
  [200, '3m 20s'],
  [7500, '2h 5m'],
  [273_600, '3d 4h'],
  [-3, '0s'],
])('%d seconds take %s', (seconds, text) => {
  expect(formatDuration(seconds)).toBe(text);
});

test.each([
  [7.4, '7s'],
  [200, '3m 20s'],
  [599.7, '10m'],
  [2533, '42m'],
  [3590, '1h'],
  [26_530, '7h 22m'],
  [48_200, '13h'],
  [273_600, '3d 4h'],
  [-3, '0s'],
])('%d seconds take about %s', (seconds, text) => {
  expect(formatEstimate(seconds)).toBe(text);
});

test.each([
  [0.4, 'just now'],
  [12, '12 s ago'],
  [150, '2 min ago'],
  [7300, '2 h ago'],
  [200_000, '2 d ago'],
])('%d seconds back is %s', (seconds, text) => {
  expect(formatAgo(seconds)).toBe(text);
});

test.each([
  [-20, 'now'],
  [12, 'in 12s'],
  [7500, 'in 2h 5m'],
])('%d seconds ahead is %s', (seconds, text) => {
  expect(formatUntil(seconds)).toBe(text);
});

test('a moment is local date and time', () => {
  expect(formatMoment(new Date(2026, 0, 2, 3, 4, 5).toISOString())).toBe('2026-01-02 03:04:05');
});

test('sizes are decimal', () => {
  expect(formatSize(326_000)).toBe('326 kB');
  expect(formatSize(12_340_000)).toBe('12.3 MB');
});

test('names for programs become words', () => {
  expect(formatName('updates_per_cycle')).toBe('Updates per cycle');
});

test('one run, two runs', () => {
  expect(formatPlural(1, 'run')).toBe('1 run');
  expect(formatPlural(2, 'run')).toBe('2 runs');
});

test('a span needs both of its ends', () => {
  expect(secondsBetween('2026-01-01T10:00:00Z', '2026-01-01T10:01:00Z')).toBe(60);
  expect(secondsBetween('2026-01-01T10:00:00Z', null)).toBeNull();
});

import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { learnServerTime, serverNow } from './server-clock';

const NOW = Date.parse('2026-01-01T10:00:00Z');

beforeEach(() => void vi.useFakeTimers({ now: NOW }));
afterEach(() => {
  answer(0);
  vi.useRealTimers();
});

/** An answer of a server whose clock is ahead by so much [s]; it took so long [s]. */
function answer(ahead: number, took = 0): void {
  learnServerTime(new Date(NOW + ahead * 1000).toUTCString(), NOW - took * 1000, NOW);
}
const ahead = (): number => (serverNow() - NOW) / 1000;

test.each([30, -30, 3600])('a clock that is off by %d s is seen, to what the header can tell', (off) => {
  answer(off);
  expect(Math.abs(ahead() - off)).toBeLessThanOrEqual(2);
  answer(0);
  expect(ahead()).toBe(0);
});

test.each([2, -2])('a clock that is off by %d s is taken for right', (off) => {
  answer(off);
  expect(ahead()).toBe(0);
});

test('a slow answer says nothing against a clock that is right', () => {
  answer(-20, 20);
  expect(ahead()).toBe(0);
});

test('an answer without a date changes nothing', () => {
  learnServerTime(null, NOW, NOW);
  learnServerTime('yesterday', NOW, NOW);
  expect(ahead()).toBe(0);
});

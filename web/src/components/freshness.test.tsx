import { render, screen } from '@testing-library/react';
import { afterEach, expect, test } from 'vitest';
import { learnServerTime } from '@/lib/server-clock';
import { Freshness } from './freshness';

/** The clock of the server is known to all tests of this process. */
const learn = (told: number): void => learnServerTime(new Date(told).toUTCString(), Date.now(), Date.now());
afterEach(() => learn(Date.now()));

test('data that came just now is fresh, whatever the time at the server', () => {
  learn(Date.now() + 60_000);
  render(<Freshness updatedAt={Date.now()} />);
  expect(screen.getByText('updated just now')).toBeTruthy();
});

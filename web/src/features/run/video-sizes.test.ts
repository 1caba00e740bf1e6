import { expect, test } from 'vitest';
import { INSET, SIZES, stepAtTime, timeOfStep } from './video-sizes';

test('every step of an episode is found in its video, and back', () => {
  for (let step = 0; step <= 100; step += 1) expect(stepAtTime(timeOfStep(step))).toBe(step);
  expect(timeOfStep(0)).toBeCloseTo(0.02);
});

test('the server takes every size that is offered', () => {
  for (const { width, height } of [...Object.values(SIZES), INSET]) {
    expect(width % 8).toBe(0);
    expect(height % 8).toBe(0);
  }
});

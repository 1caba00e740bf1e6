import { describe, expect, it } from 'vitest';
import { CHOICES } from '@/testing/samples';
import { taskNumbers } from './task-numbers';

describe('taskNumbers', () => {
  const push = CHOICES.tasks[0];

  it('says how long, how near, and how much is seen and done', () => {
    expect(push && taskNumbers(push)).toBe('50 steps · within 5 cm · 25 observed · 3 in the goal · 4 actions');
  });

  it('names position and angle where both count', () => {
    const full = push && { ...push, success_distance: 0.01, success_angle: 0.1 };
    expect(full && taskNumbers(full)).toContain('within 1 cm and 0.1 rad');
  });

  it('leaves out the position where only the rotation counts', () => {
    const rotate = push && { ...push, success_distance: null, success_angle: 0.1 };
    expect(rotate && taskNumbers(rotate)).toContain('within 0.1 rad ·');
  });
});

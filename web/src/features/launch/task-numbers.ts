/** A task's numbers in one line: how long, how near, and how much is seen and done. */
import type { Choices } from '@/client/schema.gen';

type Task = Choices['tasks'][number];

export function taskNumbers(task: Task): string {
  const near = [
    task.success_distance === null ? null : `${+(task.success_distance * 100).toFixed(1)} cm`,
    task.success_angle === null ? null : `${task.success_angle} rad`,
  ].filter((part) => part !== null);
  return [
    `${task.episode_length} steps`,
    `within ${near.join(' and ')}`,
    `${task.obs_size} observed`,
    `${task.goal_size} in the goal`,
    `${task.robot_action_size} actions`,
  ].join(' · ');
}

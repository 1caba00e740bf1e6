/** What a task asks for, and its numbers. */
import type { Choices } from '@/client/schema.gen';
import { taskNumbers } from '../task-numbers';
import classes from './launch.module.css';

export function TaskSummary({ task }: { task: Choices['tasks'][number] }) {
  return (
    <>
      {task.goal_text}
      <span className={classes.numbers}>{taskNumbers(task)}</span>
    </>
  );
}

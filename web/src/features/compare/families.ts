/** Which tasks stand together, as in the paper's figures. */

export interface Family {
  readonly title: string;
  readonly tasks: readonly string[];
}

/** The paper's figures of learning curves, in its order. */
const FAMILIES: readonly Family[] = [
  { title: 'Fetch arm, single object', tasks: ['FetchPush', 'FetchSlide', 'FetchPickAndPlace'] },
  { title: 'Fetch arm, stacking', tasks: ['FetchStack2', 'FetchStack3'] },
  { title: 'Fetch arm, non-rigid object', tasks: ['FetchTuple3', 'FetchTuple5'] },
  { title: 'Shadow hand, rotation', tasks: ['HandEggRotate', 'HandBlockRotate', 'HandPenRotate'] },
  { title: 'Shadow hand, full pose', tasks: ['HandEggFull', 'HandBlockFull', 'HandPenFull'] },
];

/** Things that belong to a task, sorted into families; tasks of none come last. */
export function byFamily<T extends { readonly task: string }>(
  things: readonly T[],
): { readonly title: string; readonly things: readonly T[] }[] {
  const known = FAMILIES.map(({ title, tasks }) => ({
    title,
    things: tasks.flatMap((task) => things.filter((thing) => thing.task === task)),
  }));
  const others = things.filter(({ task }) => !FAMILIES.some(({ tasks }) => tasks.includes(task)));
  return [...known, { title: 'Further tasks', things: others }].filter((family) => family.things.length > 0);
}

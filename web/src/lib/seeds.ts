/** Seeds as a person writes them: `0`, `0-4`, `1, 3, 7-9`. */

/** As many seeds as one launch may have. */
const MOST_SEEDS = 100;

/** As many as a study may have, whose launches add up. */
export const MOST_STUDY_SEEDS = 2000;

const SEED_LIMIT = 2 ** 31;

/** Read seeds, in ascending order without repetition; throws an Error with a sentence if they cannot be read. */
export function parseSeeds(text: string, most = MOST_SEEDS): number[] {
  const seeds = new Set<number>();
  for (const part of text.split(',').map((piece) => piece.trim())) {
    if (part === '') continue;
    const match = /^(\d+)(?:\s*-\s*(\d+))?$/.exec(part);
    if (match === null)
      throw new Error(`“${part}” is no seed; write whole numbers such as 0, 1, 2 or a range such as 0-4.`);
    const first = Number(match[1]);
    const last = match[2] === undefined ? first : Number(match[2]);
    if (last < first) throw new Error(`The range ${part} runs backwards; write ${last}-${first}.`);
    if (last >= SEED_LIMIT) throw new Error(`Seeds must be below ${SEED_LIMIT}; ${last} is not.`);
    if (last - first >= most) throw new Error(`${part} is too many; a launch may have ${most} seeds at most.`);
    for (let seed = first; seed <= last; seed += 1) seeds.add(seed);
  }
  if (seeds.size === 0) throw new Error('Enter at least one seed, such as 0.');
  if (seeds.size > most) throw new Error(`These are ${seeds.size} seeds; a launch may have ${most} at most.`);
  return [...seeds].sort((one, other) => one - other);
}

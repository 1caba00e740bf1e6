import { expect, test } from 'vitest';
import { MOST_STUDY_SEEDS, parseSeeds } from './seeds';

test.each([
  ['0', [0]],
  ['0-4', [0, 1, 2, 3, 4]],
  ['7, 1 , 3-4,1', [1, 3, 4, 7]],
])('%s names the seeds %j', (text, seeds) => {
  expect(parseSeeds(text)).toEqual(seeds);
});

test('a study may have more seeds than a launch', () => {
  expect(parseSeeds('0-119', MOST_STUDY_SEEDS)).toHaveLength(120);
});

test.each([
  ['', 'Enter at least one seed, such as 0.'],
  ['two', '“two” is no seed; write whole numbers such as 0, 1, 2 or a range such as 0-4.'],
  ['-1', '“-1” is no seed; write whole numbers such as 0, 1, 2 or a range such as 0-4.'],
  ['4-0', 'The range 4-0 runs backwards; write 0-4.'],
  ['0-100', '0-100 is too many; a launch may have 100 seeds at most.'],
  ['3000000000', 'Seeds must be below 2147483648; 3000000000 is not.'],
])('%s is refused with a sentence', (text, sentence) => {
  expect(() => parseSeeds(text)).toThrow(sentence);
});

import { expect, test } from 'vitest';
import { type Command, fittingGroups, MOST_SHOWN } from './commands';

const command = (label: string, words?: string): Command => ({ id: label, label, words, perform: () => {} });
const PAGES = { title: 'Pages', commands: [command('New run', 'launch'), command('Runs'), command('Queue')] };
const labels = (text: string, group: Parameters<typeof fittingGroups>[0][number] = PAGES) =>
  fittingGroups([group], text).flatMap(({ commands }) => commands.map(({ label }) => label));

test('all words must be there, in any order and case, and labels that begin with the text come first', () => {
  expect(labels('run')).toEqual(['Runs', 'New run']);
  expect(labels('RUN new')).toEqual(['New run']);
  expect(labels('launch')).toEqual(['New run']);
  expect(labels('nothing of it')).toEqual([]);
});

test('long groups wait for a text and show no more than fits', () => {
  const launches = { title: 'Launch', isLong: true, commands: [...'abcdefghijkl'].map((at) => command(`Push ${at}`)) };
  expect(labels('', launches)).toEqual([]);
  expect(labels('push', launches)).toHaveLength(MOST_SHOWN);
});

test('what the server has found stays, whatever its words', () => {
  expect(labels('note', { title: 'Runs', isFound: true, commands: [command('FetchPush')] })).toEqual(['FetchPush']);
});

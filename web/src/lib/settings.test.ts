import { expect, test } from 'vitest';
import { describeBounds, overridesOf, readSettingGroups } from '@/lib/settings';
import { CONFIG_SCHEMA, DEFAULTS } from '@/testing/samples';

const groups = readSettingGroups(CONFIG_SCHEMA);

function overrides(typed: Record<string, string>) {
  return overridesOf(groups, typed, DEFAULTS);
}

test('settings are read by group, single ones at the top are left to others', () => {
  expect(groups.map((group) => group.name)).toEqual(['loop', 'agent', 'compute']);
  expect(groups[0]?.help).toBe('How much is collected.');
  expect(groups.flatMap((group) => group.settings.map((setting) => [setting.path, setting.kind]))).toEqual([
    ['loop.epochs', 'integer'],
    ['loop.batch_size', 'integer'],
    ['agent.hidden_sizes', 'integers'],
    ['agent.gamma', 'number'],
    ['compute.device', 'choice'],
  ]);
});

test('nothing typed, nothing sent', () => {
  expect(overrides({})).toEqual({ values: {}, changed: [], problems: {} });
});

test('what equals the preset is not sent, however it is written', () => {
  expect(
    overrides({ 'loop.epochs': ' 20 ', 'agent.gamma': '9.8e-1', 'agent.hidden_sizes': '256,256' }).changed,
  ).toEqual([]);
});

test('changed values are sent nested, with their types', () => {
  const { values, changed } = overrides({
    'loop.batch_size': '512',
    'loop.epochs': '3',
    'agent.hidden_sizes': '64, 64',
    'compute.device': 'cpu',
  });
  expect(values).toEqual({
    loop: { batch_size: 512, epochs: 3 },
    agent: { hidden_sizes: [64, 64] },
    compute: { device: 'cpu' },
  });
  expect(changed).toHaveLength(4);
});

test('what cannot be meant gets a sentence and is not sent', () => {
  const { values, problems } = overrides({ 'loop.epochs': '-1', 'loop.batch_size': '2.5', 'agent.gamma': 'high' });
  expect(values).toEqual({});
  expect(problems).toEqual({
    'loop.epochs': 'It must be above 0.',
    'loop.batch_size': 'Enter a whole number, such as 3.',
    'agent.gamma': 'Enter a number.',
  });
});

test('ranges are told in words', () => {
  const gamma = groups[1]?.settings[1];
  expect(gamma && describeBounds(gamma)).toBe('above 0 and below 1');
});

import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { expect, test } from 'vitest';
import { EQUATIONS, readEquation } from './equations';
import { METHOD_HELP } from './method-help';
import { GROUP_SECTIONS, SETTING_EQUATIONS } from './setting-help';

const read = (path: string) => readFileSync(resolve(import.meta.dirname, '../../..', path), 'utf8');

/** The names in the first table of the methods' page, which is written from the code. */
function methodsOfDocs(): string[] {
  const [, table = ''] = read('docs/methods.md').split('goals replaced |');
  return [...(table.split('\n\n')[0] ?? '').matchAll(/^\| `([^`]+)`/gm)].map((match) => match[1] ?? '');
}

test('every method has two sentences or more, an equation and a reason to choose it', () => {
  const methods = Object.keys(METHOD_HELP);
  expect(methods).toEqual(methodsOfDocs());
  for (const { does, equations, choose } of Object.values(METHOD_HELP)) {
    expect(does.match(/[.;] ?/g)?.length).toBeGreaterThanOrEqual(2);
    expect(equations.length).toBeGreaterThan(0);
    expect(choose).toMatch(/^Choose it /);
  }
});

test('every setting with an equation is a setting', () => {
  const source = read('sldr_core/config/train.py') + read('sldr_core/config/method_settings.py');
  for (const [group, name] of Object.keys(SETTING_EQUATIONS).map((path) => path.split('.'))) {
    expect(GROUP_SECTIONS[group ?? '']).toBeDefined();
    expect(source).toMatch(new RegExp(`^ {4}${name}: `, 'm'));
  }
  for (const group of Object.keys(GROUP_SECTIONS)) expect(source).toMatch(new RegExp(`^ {4}${group}: \\w+Config`, 'm'));
});

test('a written equation is cut into what stands on, below and above the line', () => {
  expect(readEquation('Q^ν(z_{t+1})')).toEqual([
    { text: 'Q', level: 'line' },
    { text: 'ν', level: 'raised' },
    { text: '(z', level: 'line' },
    { text: 't+1', level: 'index' },
    { text: ')', level: 'line' },
  ]);
  for (const { written } of Object.values(EQUATIONS)) {
    // Braces may also be those of a set.
    expect(readEquation(written).some(({ text }) => /[_^]/.test(text))).toBe(false);
  }
});

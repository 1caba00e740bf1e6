import { expect, test } from 'vitest';
import { lineStyle, methodStyle, type Scheme, STATE_COLORS } from '@/lib/palette';

const GROUND: Record<Scheme, string> = { light: '#ffffff', dark: '#1a1d22' };
const SCHEMES: Scheme[] = ['light', 'dark'];

function luminance(color: string): number {
  const [red = 0, green = 0, blue = 0] = [1, 3, 5].map((at) => {
    const part = Number.parseInt(color.slice(at, at + 2), 16) / 255;
    return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

function contrast(one: string, other: string): number {
  const [low = 0, high = 0] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
}

test.each(SCHEMES)('every line stands out from a %s page', (scheme) => {
  for (let at = 0; at < 7; at += 1) {
    expect(contrast(lineStyle(at, scheme).color, GROUND[scheme])).toBeGreaterThan(3);
  }
});

test.each(SCHEMES)('every state is readable as text on a %s page', (scheme) => {
  for (const colors of Object.values(STATE_COLORS)) {
    expect(contrast(colors[scheme], GROUND[scheme])).toBeGreaterThan(4.5);
  }
});

test('lines next to each other differ in dash too', () => {
  expect(lineStyle(0, 'light').dash).not.toEqual(lineStyle(1, 'light').dash);
});

const METHODS = ['ddpg', 'her', 'cher', 'her-dense', 'ddpg-sldr', 'her-rnd', 'her-sldr'];

test.each(SCHEMES)('each method of the paper has a colour and a dash of its own on a %s page', (scheme) => {
  const styles = METHODS.map((method) => methodStyle(method, scheme));
  expect(new Set(styles.map(({ color }) => color)).size).toBe(METHODS.length);
  expect(new Set(styles.map(({ dash }) => dash.join())).size).toBe(METHODS.length);
});

test('a variant of a method keeps its colour and changes its dash', () => {
  expect(methodStyle('her', 'light', 1).color).toBe(methodStyle('her', 'light').color);
  expect(methodStyle('her', 'light', 1).dash).not.toEqual(methodStyle('her', 'light').dash);
});

test('a method that nobody knows keeps its style', () => {
  expect(methodStyle('mine', 'dark')).toEqual(methodStyle('mine', 'dark'));
});

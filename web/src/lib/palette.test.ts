import { expect, test } from 'vitest';
import { groupStyle, lineStyle, type Scheme, STATE_COLORS } from '@/lib/palette';

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

test.each(SCHEMES)('seven methods have a colour and a dash each on a %s page', (scheme) => {
  const styles = [0, 1, 2, 3, 4, 5, 6].map((place) => groupStyle({ color: place, dash: place }, scheme));
  expect(new Set(styles.map(({ color }) => color)).size).toBe(7);
  expect(new Set(styles.map(({ dash }) => dash.join())).size).toBe(7);
});

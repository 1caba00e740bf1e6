import { expect, test } from 'vitest';
import { bundleAddress, figureAddress } from './exports';

function questionOf(address: string): URLSearchParams {
  return new URL(address, 'http://here').searchParams;
}

test('a figure is drawn of what the page shows', () => {
  const address = figureAddress(
    {
      tasks: 'FetchPush,FetchSlide',
      statistic: 'iqm',
      level: 0.9,
      x: 'env_steps',
      drop: 'yes',
      pin: 'her',
      logx: 'yes',
    },
    'svg',
    'single',
  );
  expect(address).toMatch(/^\/api\/compare\/figure\.svg\?/);
  const asked = questionOf(address);
  expect(asked.getAll('task')).toEqual(['FetchPush', 'FetchSlide']);
  expect(Object.fromEntries(asked)).toMatchObject({
    kind: 'curves',
    statistic: 'iqm',
    level: '0.9',
    x: 'env_steps',
    drop_ended: 'true',
    log_x: 'true',
    log_y: 'false',
    width: 'single',
    metric: 'test/success_rate',
  });
  expect(asked.has('phase')).toBe(false);
});

test('on the tab of best models it is the bar figure', () => {
  expect(questionOf(figureAddress({ tab: 'best' }, 'tex', 'double')).get('kind')).toBe('best');
});

test('a bundle may be anonymous', () => {
  expect(questionOf(bundleAddress({ runs: 'a,b' }, 'double', true)).get('anonymous')).toBe('true');
  expect(questionOf(bundleAddress({ runs: 'a,b' }, 'double', true)).getAll('run')).toEqual(['a', 'b']);
});

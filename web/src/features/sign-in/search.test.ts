import { expect, test } from 'vitest';
import { readSignInSearch } from './search';

test('the way back is a path of ours', () => {
  expect(readSignInSearch({ from: '/runs/a?tab=files' }).from).toBe('/runs/a?tab=files');
});

test.each(['https://evil.example', '//evil.example', '/\\evil.example', 'javascript:alert(1)', 7])(
  'a way back that leads elsewhere is dropped: %s',
  (from) => {
    expect(readSignInSearch({ from }).from).toBeUndefined();
  },
);

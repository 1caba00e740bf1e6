import { act, renderHook } from '@testing-library/react';
import { expect, test } from 'vitest';
import { useKeptDraft } from './use-kept-draft';

const isDraft = (kept: unknown): kept is string => typeof kept === 'string';
const open = (beginning: string) => renderHook(() => useKeptDraft('', { form: 'f', beginning, isDraft })).result;

test('a draft is there again where it began, and nowhere else', () => {
  const form = open('a');
  act(() => form.current.setDraft('typed'));
  expect(open('b').current.draft).toBe('');
  expect(open('a').current.draft).toBe('typed');
});

test('a draft that has served, or was taken back, is gone', () => {
  const form = open('a');
  act(() => form.current.setDraft('typed'));
  act(() => form.current.forget());
  expect(open('a').current.draft).toBe('');
  act(() => form.current.setDraft('typed again'));
  act(() => form.current.setDraft(''));
  expect(window.sessionStorage).toHaveLength(0);
});

test.each(['{', '7', '"a"', '{"beginning":"a","draft":7}'])('what is kept as %s is no draft', (kept) => {
  window.sessionStorage.setItem('sldr-draft-f', kept);
  expect(open('a').current.draft).toBe('');
});

import { expect, test } from 'vitest';
import { ACCOUNT, PLACES } from './places';
import { readShortcut, SHORTCUTS, takesKeys } from './shortcuts';

const PLAIN = { ctrlKey: false, metaKey: false, altKey: false };

test('control or command with K asks for the palette, K alone and with Alt for nothing', () => {
  expect(readShortcut({ ...PLAIN, ctrlKey: true, key: 'k' }, null)).toEqual({ show: 'palette' });
  expect(readShortcut({ ...PLAIN, metaKey: true, key: 'K' }, null)).toEqual({ show: 'palette' });
  expect(readShortcut({ ...PLAIN, key: 'k' }, null)).toBeUndefined();
  expect(readShortcut({ ...PLAIN, ctrlKey: true, altKey: true, key: 'k' }, null)).toBeUndefined();
});

test('a place is gone to with its key after g, and with no other', () => {
  expect(readShortcut({ ...PLAIN, key: 's' }, 'g')).toEqual({ go: '/studies' });
  expect(readShortcut({ ...PLAIN, key: 's' }, null)).toBeUndefined();
  expect(readShortcut({ ...PLAIN, key: 's' }, 'x')).toBeUndefined();
  expect(readShortcut({ ...PLAIN, key: 'z' }, 'g')).toBeUndefined();
});

test('no two places share a key, and the list names each', () => {
  const places = [...PLACES, ACCOUNT];
  expect(new Set(places.map(({ key }) => key)).size).toBe(places.length);
  const listed = SHORTCUTS.flatMap((group) => group.shortcuts.flatMap(({ keys }) => keys));
  for (const { key } of places) expect(listed).toContain(`g ${key}`);
});

test('fields and dialogs keep their keys; boxes, sliders and the page do not', () => {
  document.body.innerHTML =
    '<input id="text"><input id="box" type="checkbox"><input id="slider" type="range"><textarea id="area"></textarea>' +
    '<div role="dialog"><button id="inside"></button></div><button id="outside"></button>';
  const at = (id: string) => takesKeys(document.getElementById(id));
  expect(['text', 'area', 'inside'].map(at)).toEqual([true, true, true]);
  expect(['box', 'slider', 'outside'].map(at)).toEqual([false, false, false]);
  document.body.innerHTML = '';
});

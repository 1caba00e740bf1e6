import { expect, test } from 'vitest';
import { needsKey, readTransportKey } from './transport-keys';

const STATE = { step: 5, steps: 50, playing: true, speed: 1, loop: false };

test.each([
  [' ', false, { do: 'toggle' }],
  ['ArrowRight', false, { do: 'step', by: 1 }],
  ['ArrowLeft', true, { do: 'step', by: -10 }],
  ['Home', false, { do: 'seek', step: 0 }],
  ['End', false, { do: 'seek', step: 50 }],
  ['x', false, undefined],
])('the key %j asks for what it says', (key, isShifted, command) => {
  expect(readTransportKey(key, isShifted, STATE)).toEqual(command);
});

test('no leap is longer than the episode', () => {
  expect(readTransportKey('ArrowRight', true, { ...STATE, steps: 4 })).toEqual({ do: 'step', by: 4 });
});

test('what has the focus keeps the keys that it needs', () => {
  document.body.innerHTML =
    '<input id="text"><input id="range" type="range"><button id="button">x</button><div role="tablist"><i id="tab"></i></div>' +
    '<section tabindex="0" id="list"><button id="inner">x</button></section><main tabindex="-1" id="main"></main>';
  const at = (id: string): HTMLElement | null => document.getElementById(id);
  expect(needsKey(at('text'), 'ArrowLeft')).toBe(true);
  expect(needsKey(at('range'), 'ArrowLeft')).toBe(true);
  expect(needsKey(at('range'), ' ')).toBe(false);
  expect(needsKey(at('button'), ' ')).toBe(true);
  expect(needsKey(at('button'), 'ArrowLeft')).toBe(false);
  expect(needsKey(at('tab'), 'ArrowLeft')).toBe(true);
  for (const key of [' ', 'ArrowLeft', 'Home', 'End']) {
    expect(needsKey(at('list'), key)).toBe(true);
    expect(needsKey(at('inner'), key)).toBe(true);
    expect(needsKey(at('main'), key)).toBe(false);
  }
  expect(needsKey(document.body, ' ')).toBe(false);
});

/** What jsdom lacks and the page needs. */
import { cleanup, configure } from '@testing-library/react';
import { afterEach } from 'vitest';

// Two busy cores render slowly; a test still ends as soon as what it waits for is there.
configure({ asyncUtilTimeout: 12_000 });

class NoResizes implements ResizeObserver {
  observe(): void {}
  unobserve(): void {}
  disconnect(): void {}
}

/** All is on the screen. */
class AllSeen implements IntersectionObserver {
  readonly root = null;
  readonly rootMargin = '';
  readonly scrollMargin = '';
  readonly thresholds = [];
  readonly #tell: IntersectionObserverCallback;
  constructor(tell: IntersectionObserverCallback) {
    this.#tell = tell;
  }
  observe(): void {
    this.#tell([{ isIntersecting: true } as IntersectionObserverEntry], this);
  }
  unobserve(): void {}
  disconnect(): void {}
  takeRecords(): IntersectionObserverEntry[] {
    return [];
  }
}

globalThis.ResizeObserver = NoResizes;
// Nothing is laid out, so that what shows only the rows in view has to be told of a view.
Object.defineProperties(Element.prototype, {
  clientHeight: { configurable: true, get: () => 700 },
  clientWidth: { configurable: true, get: () => 1200 },
  scrollHeight: { configurable: true, get: () => 1_000_000 },
});
Object.defineProperty(document, 'fonts', { configurable: true, value: new EventTarget() });
globalThis.IntersectionObserver = AllSeen;
window.scrollTo = () => {};
Element.prototype.scrollTo = function (this: Element, to?: ScrollToOptions | number) {
  this.scrollTop = typeof to === 'object' ? (to.top ?? 0) : 0;
  this.dispatchEvent(new Event('scroll'));
};
Element.prototype.scrollIntoView = () => {};
window.matchMedia = (query) => ({
  matches: false,
  media: query,
  onchange: null,
  addEventListener: () => {},
  removeEventListener: () => {},
  addListener: () => {},
  removeListener: () => {},
  dispatchEvent: () => false,
});

afterEach(() => {
  cleanup();
  window.localStorage.clear();
  window.sessionStorage.clear();
});

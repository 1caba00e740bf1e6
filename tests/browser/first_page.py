"""How soon the first page can be used, and what it weighs: `python tests/browser/first_page.py`.

It serves the whole product over 200 runs and opens the page in headless Chromium, each time as somebody who was never
here: nothing is cached. The page can be used once the table is drawn, no task of more than 50 ms follows, and a button
answers. Bytes are those on the wire, with headers.
"""

from __future__ import annotations

import argparse
import os
import statistics
import sys
import tempfile
from contextlib import ExitStack, closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from playwright.sync_api import Browser, CDPSession, sync_playwright

sys.path.insert(0, str(Path(__file__).parents[1]))

from many_runs import launch_many, train_many
from served_product import WHOLE, serving
from signed_in import cookies

from backend.store.database import open_database
from backend.store.settings import Settings, sqlite_url

RUNS = 200
PORT = 8733
VISITS = 7
WINDOW = {"width": 1280, "height": 800}
SOON_MS = 60_000
QUIET_MS = 1_500
"""So long nothing has kept the page's thread before it counts as quiet [ms]."""

SOONEST_S = 2.0
"""The page can be used by then [s]."""
HEAVIEST = 8
"""Addresses that are told."""
LIGHTEST_KB = 300.0
"""It weighs no more before that [kB]."""

WATCH = """
    window.seen = { drawn: null, busy: 0 };
    new PerformanceObserver(list => {
        for (const { startTime, duration } of list.getEntries()) window.seen.busy = startTime + duration;
    }).observe({ type: 'longtask', buffered: true });
    new MutationObserver((_, watch) => {
        if (!document.querySelector('main [data-run]')) return;
        watch.disconnect();
        // The frame that shows it is the next one's beginning.
        requestAnimationFrame(() => setTimeout(() => { window.seen.drawn = performance.now(); }));
    }).observe(document, { childList: true, subtree: true });
"""
"""Notes when the table was drawn, and when the last task of more than 50 ms was over [ms since the navigation]."""

IS_QUIET = f"""() => window.seen.drawn !== null
    && performance.now() - Math.max(window.seen.drawn, window.seen.busy) > {QUIET_MS}"""

PRESS = """async () => {
    const button = document.querySelector('nav button[aria-expanded]');
    const [was, begun] = [button.getAttribute('aria-expanded'), performance.now()];
    button.click();
    while (button.getAttribute('aria-expanded') === was) await new Promise(requestAnimationFrame);
    return performance.now() - begun;
}"""
"""Milliseconds until the rail's own button has answered."""


@dataclass(frozen=True)
class Visit:
    """What one visit took."""

    usable_s: float
    """From the navigation until the page can be used [s]."""
    answer_ms: float
    """From pressing a button to its answer [ms]."""
    thread_ms: float
    """What the page's own thread took of a core; it stands still while other programs have the core [ms]."""
    kb_by_address: dict[str, float]
    """What came, with headers, by address."""

    @property
    def wire_kb(self) -> float:
        """All that came."""
        return sum(self.kb_by_address.values())


class Wire:
    """Count what comes to a page."""

    def __init__(self, session: CDPSession) -> None:
        self.kb_by_address: dict[str, float] = {}
        self._addresses: dict[str, str] = {}
        session.on("Network.requestWillBeSent", self._sent)
        session.on("Network.loadingFinished", self._finished)
        session.send("Network.enable")

    def _sent(self, event: dict[str, Any]) -> None:
        self._addresses[event["requestId"]] = urlsplit(event["request"]["url"]).path

    def _finished(self, event: dict[str, Any]) -> None:
        address = self._addresses.get(event["requestId"], "?")
        self.kb_by_address[address] = self.kb_by_address.get(address, 0.0) + event["encodedDataLength"] / 1000


def main() -> int:
    """Print the figures; return 1 if the page is too slow or too heavy."""
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0] if __doc__ else "")
    parser.add_argument("--visits", type=int, default=VISITS)
    arguments = parser.parse_args()
    with ExitStack() as stack:
        address = stack.enter_context(_filled_service(stack))
        playwright = stack.enter_context(sync_playwright())
        path = os.environ.get("SLDR_CHROMIUM", "/usr/bin/chromium")
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        visits = [_visit(browser, address) for _ in range(arguments.visits)]
    usable = sorted(visit.usable_s for visit in visits)
    weight = statistics.median(visit.wire_kb for visit in visits)
    median = statistics.median(usable)
    print(f"usable after {median:.2f} s ({usable[0]:.2f} to {usable[-1]:.2f}; at most {SOONEST_S:g} s)")
    print(f"a button answers after {statistics.median(visit.answer_ms for visit in visits):.0f} ms")
    print(f"the page's thread takes {statistics.median(visit.thread_ms for visit in visits):.0f} ms of a core")
    came = sorted(visits[-1].kb_by_address.items(), key=lambda item: -item[1])
    print(f"{weight:.0f} kB on the wire from {len(came)} addresses (at most {LIGHTEST_KB:g} kB); the heaviest:")
    for address, kb in came[:HEAVIEST]:
        print(f"{kb:8.1f} kB  {address}")
    return 0 if median <= SOONEST_S and weight <= LIGHTEST_KB else 1


def _filled_service(stack: ExitStack):
    home = Path(stack.enter_context(tempfile.TemporaryDirectory()))
    with closing(open_database(Settings(home=home, database_url=sqlite_url(home)))) as database:
        launch_many(database, RUNS)
        train_many(database, RUNS, epochs=20, metrics=5)
    return serving(home, PORT, WHOLE)


def _visit(browser: Browser, address: str) -> Visit:
    context = browser.new_context(viewport=WINDOW)  # type: ignore[arg-type]
    context.add_cookies(cookies())  # type: ignore[arg-type]
    context.add_init_script(WATCH)
    page = context.new_page()
    session = context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    wire = Wire(session)
    page.goto(address, wait_until="commit")
    page.wait_for_function(IS_QUIET, timeout=SOON_MS)
    usable_ms = page.evaluate("Math.max(window.seen.drawn, window.seen.busy)")
    thread_ms = _thread_ms(session)
    came = dict(wire.kb_by_address)
    answer_ms = page.evaluate(PRESS)
    context.close()
    return Visit(usable_ms / 1000, answer_ms, thread_ms, came)


def _thread_ms(session: CDPSession) -> float:
    metrics = {metric["name"]: metric["value"] for metric in session.send("Performance.getMetrics")["metrics"]}
    return 1000 * metrics["TaskDuration"]


if __name__ == "__main__":
    sys.exit(main())

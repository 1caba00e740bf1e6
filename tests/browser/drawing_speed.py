"""How long the compare page takes to draw a whole study: `python tests/browser/drawing_speed.py`.

It fills a store with the paper's 13 tasks x 7 methods x 5 seeds, serves it, and opens the page in headless Chromium,
in a window so tall that every panel is on the screen. The time runs from the answer's last byte to the last panel.
"""

from __future__ import annotations

import argparse
import os
import statistics
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path

from playwright.sync_api import Browser, sync_playwright

sys.path.insert(0, str(Path(__file__).parents[1]))

from plausible_runs import play_out
from served_product import PAGE_AND_API, serving
from signed_in import cookies

from backend.store.database import open_database
from backend.store.settings import Settings, sqlite_url
from backend.store.studies.launch import create_study
from backend.store.studies.spec import StudySpec
from sldr_core.config import METHODS, TASKS

SEEDS = 5
EPOCHS = 50
PORT = 8732
WINDOW = (1280, 2600)
VIEWS = {
    "median and quartiles": "",
    "each seed": "?statistic=seeds",
    "median over faint seeds": "?seeds=yes",
}

WAIT = """panels => new Promise(resolve => {
    const look = () => {
        const drawn = document.querySelectorAll('figure canvas').length;
        if (drawn < panels) return requestAnimationFrame(look);
        // The plots paint in a microtask of their own; the next frame is behind it.
        requestAnimationFrame(() => setTimeout(() => {
            const [answer] = performance.getEntriesByType('resource').filter(({ name }) => /compare(\\?|$)/.test(name));
            resolve([performance.now() - answer.responseEnd, performance.now()]);
        }));
    };
    look();
})"""
"""Milliseconds from the answer to the last panel, and from the start of the visit."""


def main() -> None:
    """Print a line a view."""
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0] if __doc__ else "")
    parser.add_argument("--address", help="a service that is filled already")
    parser.add_argument("--repeats", type=int, default=5, help="visits of each view")
    arguments = parser.parse_args()
    with ExitStack() as stack:
        address = arguments.address or stack.enter_context(_filled_service(stack))
        playwright = stack.enter_context(sync_playwright())
        path = os.environ.get("SLDR_CHROMIUM", "/usr/bin/chromium")
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        for name, question in VIEWS.items():
            times = [_visit(browser, f"{address}/compare{question}") for _ in range(arguments.repeats)]
            drawing = sorted(drawn for drawn, _, _ in times)
            whole = statistics.median(visit for _, visit, _ in times)
            busy = statistics.median(work for _, _, work in times)
            print(
                f"{name:24} drawn {statistics.median(drawing):5.0f} ms after the answer"
                f" ({drawing[0]:.0f} to {drawing[-1]:.0f}), {whole:5.0f} ms after the click;"
                f" {busy:4.0f} ms of one core for the whole visit"
            )


def _filled_service(stack: ExitStack):
    home = Path(stack.enter_context(tempfile.TemporaryDirectory()))
    database = open_database(Settings(home=home, database_url=sqlite_url(home)))
    print(f"Filling a store with {len(TASKS)} tasks, {len(METHODS)} methods, {SEEDS} seeds...", flush=True)
    create_study(database, "All", StudySpec(tuple(TASKS), tuple(METHODS), tuple(range(SEEDS)), "quick"))
    play_out(database, EPOCHS)
    database.close()
    return serving(home, PORT, PAGE_AND_API)


def _visit(browser: Browser, address: str) -> tuple[float, float, float]:
    page = browser.new_page(viewport={"width": WINDOW[0], "height": WINDOW[1]})
    page.context.add_cookies(cookies())  # type: ignore[arg-type]
    session = page.context.new_cdp_session(page)
    # Ticks of the page's own thread: they stand still while other programs have the core.
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    page.goto(address, wait_until="commit")
    drawn, visit = page.evaluate(WAIT, len(TASKS))
    metrics = {metric["name"]: metric["value"] for metric in session.send("Performance.getMetrics")["metrics"]}
    page.close()
    return drawn, visit, 1000 * metrics["TaskDuration"]


if __name__ == "__main__":
    main()

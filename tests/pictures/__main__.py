"""Take a picture of every page, light and dark: `python tests/pictures docs/pictures` (or `make pictures`).

The store behind the pages is filled with plausible curves through its own functions; nothing is trained.
"""

from __future__ import annotations

import argparse
import io
import os
import socket
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from PIL import Image
from playwright.sync_api import Browser, Page, sync_playwright

sys.path.insert(0, str(Path(__file__).parents[1]))

import signed_in
from plausible_runs import WHOLE, play_out
from served_product import PAGE_AND_API, serving

from backend.api.access.passwords import Passwords
from backend.store.access.accounts import create_account, set_password
from backend.store.access.api_tokens import create_token
from backend.store.access.roles import Role
from backend.store.claims import Claim
from backend.store.database import Database, open_database
from backend.store.settings import Settings, sqlite_url
from backend.store.studies.launch import create_study
from backend.store.studies.spec import StudySpec
from backend.store.workers import beat, list_workers
from sldr_core.config import METHODS
from worker.render import render_all_pictures

TASKS = ("FetchPush", "FetchSlide", "FetchPickAndPlace", "FetchStack2", "HandEggRotate", "HandBlockRotate")
SEEDS = (0, 1, 2, 3, 4)
EPOCHS = 30
WINDOW = (1280, 860)
SCHEMES = ("light", "dark")
MOST_BYTES = 150_000
COLORS = 256
"""Colours of a picture, as many as a byte can name."""
SOON_MS = 60_000
"""A page has drawn itself by then [ms]."""

PAGES = {
    "runs": ("/", "[data-run]"),
    "launch": ("/launch?task=FetchPickAndPlace&method=her-sldr", "input[type=radio]"),
    "run": ("/runs/{run_id}", "figure canvas"),
    "studies": ("/studies", "main a[href^='/studies/']"),
    "new-study": ("/studies/new", "main input"),
    "study": ("/studies/{study_id}", "main table"),
    "compare": ("/compare?study={study_id}", "figure canvas"),
    "compare-seeds": ("/compare?tasks=FetchPush,FetchStack2&seeds=yes&smooth=0.6&statistic=iqm", "figure canvas"),
    "best-models": ("/compare?tab=best", "figure canvas"),
    "configs": ("/compare/configs?runs={run_id},{other_id}", "main table"),
    "queue": ("/queue", "main li"),
    "workers": ("/workers", "main h2, main h3"),
    "settings": ("/settings", "main h2"),
}
"""Address of each page, and what is there once it has drawn itself."""

ACCESS_PAGES = {
    "sign-in": ("/sign-in", "main input"),
    "account": ("/account", "main table"),
    "accounts": ("/accounts", "main table"),
}
"""The same of pages that tell more where people have accounts."""

PEOPLE: dict[str, Role] = {"ada": "admin", "grace": "operator", "katherine": "operator", "visitor": "viewer"}
"""Who has an account; the first one looks."""
PASSWORD = "seven purple otters"


def main() -> None:
    """Fill, serve, visit, save."""
    parser = argparse.ArgumentParser(description="Take a picture of every page, light and dark.")
    parser.add_argument("directory", type=Path, help="where the pictures go")
    parser.add_argument(
        "--only", choices=[*PAGES, *ACCESS_PAGES], action="append", help="a page to take; may be given again"
    )
    parser.add_argument("--no-tasks", dest="with_tasks", action="store_false", help="draw no pictures of tasks")
    arguments = parser.parse_args()
    directory: Path = arguments.directory
    directory.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name, sync_playwright() as playwright:
        home = Path(name)
        database = open_database(Settings(home=home, database_url=sqlite_url(home)))
        _fill(database)
        _let_in(database)
        if arguments.with_tasks:
            render_all_pictures(home)
        path = os.environ.get("SLDR_CHROMIUM", "/usr/bin/chromium")
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox", "--disable-dev-shm-usage"])
        wanted = arguments.only or [*PAGES, *ACCESS_PAGES]
        with serving(home, _free_port(), PAGE_AND_API) as address:
            _visit_all(browser, address, database, directory, [name for name in wanted if name in PAGES])
        with serving(home, _free_port(), PAGE_AND_API, options=("--accounts",)) as address:
            _visit_access(browser, address, directory, [name for name in wanted if name in ACCESS_PAGES])
        browser.close()
        database.close()


def _fill(database: Database) -> None:
    """Put a study into the store that is nearly over, and one that waits."""
    create_study(database, "Fetch and hand, all methods", StudySpec(TASKS, tuple(METHODS), SEEDS, "quick"))
    play_out(database, EPOCHS, _share_of)
    create_study(database, "Pen, two methods", StudySpec(("HandPenRotate",), ("her", "her-sldr"), SEEDS[:3], "quick"))
    play_out(database, EPOCHS, _share_of, most=1, host="lab-2")


def _let_in(database: Database) -> None:
    """Give people accounts, the first one a password too."""
    made = [create_account(database, name, role) for name, role in PEOPLE.items()]
    set_password(database, made[0].id, Passwords().hash(PASSWORD))
    create_token(database, made[0].id, "notebook on lab-2", "operator", None)


def _share_of(claimed: Claim) -> float:
    """Return how far a run is: in one task the last seed is still at it, and one run failed."""
    config = claimed.config
    if config.phase == "locomotion" or config.task != "HandBlockRotate":
        return WHOLE
    if config.method == "cher" and config.seed == 0:
        return -0.4
    return 0.55 if config.seed == SEEDS[-1] else WHOLE


def _visit_all(browser: Browser, address: str, database: Database, directory: Path, wanted: Sequence[str]) -> None:
    def get(path: str) -> dict[str, list[dict[str, str]]]:
        return signed_in.get(address, path)

    first = get("/api/runs?state=running&task=HandBlockRotate&method=her-sldr")["runs"][0]["id"]
    other = get("/api/runs?state=succeeded&task=HandBlockRotate&method=her")["runs"][0]["id"]
    names = {"run_id": first, "other_id": other, "study_id": get("/api/studies")["studies"][-1]["id"]}
    for scheme in SCHEMES:
        page = browser.new_page(
            viewport={"width": WINDOW[0], "height": WINDOW[1]},
            color_scheme=scheme,  # type: ignore[arg-type]
        )
        page.context.add_cookies(signed_in.cookies())  # type: ignore[arg-type]
        for name in wanted:
            path, drawn = PAGES[name]
            for worker in list_workers(database):
                beat(database, worker.id, memory_used=41 * 10**9)
            page.goto(address + path.format(**names))
            page.locator(drawn).first.wait_for(timeout=SOON_MS)
            page.wait_for_load_state("networkidle")
            _save(page, directory / f"{name}-{scheme}.png")
        page.close()


def _visit_access(browser: Browser, address: str, directory: Path, wanted: Sequence[str]) -> None:
    """Visit the pages that are about people, first as nobody, then as the admin."""
    for scheme in SCHEMES:
        context = browser.new_context(
            viewport={"width": WINDOW[0], "height": WINDOW[1]},
            color_scheme=scheme,  # type: ignore[arg-type]
        )
        page = context.new_page()
        for name in wanted:
            path, drawn = ACCESS_PAGES[name]
            if name != "sign-in":
                data = {"name": next(iter(PEOPLE)), "password": PASSWORD}
                context.request.post(f"{address}/api/auth/sign-in", data=data, headers={"Origin": address})
            page.goto(address + path)
            page.locator(drawn).first.wait_for(timeout=SOON_MS)
            page.wait_for_load_state("networkidle")
            _save(page, directory / f"{name}-{scheme}.png")
        context.close()


def _save(page: Page, path: Path) -> None:
    """Save what is on the screen, with few colours and few bytes.

    Raises:
        RuntimeError: the picture is larger than the repository should carry.
    """
    picture = Image.open(io.BytesIO(page.screenshot(animations="disabled"))).convert("RGB")
    picture.quantize(COLORS, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(path, optimize=True)
    if path.stat().st_size > MOST_BYTES:
        raise RuntimeError(f"{path} has {path.stat().st_size} bytes, above {MOST_BYTES}; show less or lower COLORS.")
    print(f"{path} {path.stat().st_size // 1000} kB", flush=True)


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


if __name__ == "__main__":
    main()

"""The whole product in real processes, and a real browser in front of it."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Generator
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from plausible_runs import play_out
from playwright.sync_api import BrowserContext
from served_product import PAGE_AND_API, STARTED_WITHIN_S, WHOLE, serving
from signed_in import cookies

from backend.store.database import open_database
from backend.store.launches import LaunchOrder, launch
from backend.store.settings import Settings, sqlite_url
from backend.store.studies.launch import create_study
from backend.store.studies.spec import StudySpec
from sldr_core.config import TASKS

SEEDS = (0, 1, 2)
"""As many as a band needs; the last one's runs have not ended."""

DRAWN = "FetchPush"
"""The task whose picture is drawn for real; drawing all of them takes a minute of a core."""

FEW_FRAMES = """if (window !== window.top) {
    window.requestAnimationFrame = draw => window.setTimeout(() => draw(performance.now()), 200);
    window.cancelAnimationFrame = window.clearTimeout;
}"""
"""Let a 3D view, which lies in a frame of the page, draw five pictures a second: software rendering would take every
core for more."""


def leave_to_draw(home: Path, task: str) -> None:
    """Put a picture of one pixel in the place of every other task's."""
    pictures = home / "pictures"
    pictures.mkdir()
    for other in TASKS.keys() - {task}:
        Image.new("RGB", (1, 1)).save(pictures / f"{other}.png")


FEW_PIXELS = {"device_scale_factor": 0.5}
"""Let pages be laid out in their usual size and drawn in half of it: in software each pixel of a scene costs."""


@pytest.fixture
def new_context(new_context: Callable[..., BrowserContext]) -> Callable[..., BrowserContext]:
    """Return a way to get browsers that spare the processor."""

    def make(**options: Any) -> BrowserContext:
        context = new_context(**FEW_PIXELS, **options)
        context.add_init_script(FEW_FRAMES)
        return context

    return make


@pytest.fixture
def context(new_context: Callable[..., BrowserContext]) -> BrowserContext:
    """Return a browser that is signed in to everything that is served."""
    context = new_context()
    context.add_cookies(cookies())  # type: ignore[arg-type]
    return context


@pytest.fixture(scope="session")
def product(tmp_path_factory: pytest.TempPathFactory, find_free_port: Callable[[], int]) -> Generator[str]:
    """Serve page, API, a worker and the viewer host with an empty data directory; return the address."""
    home = tmp_path_factory.mktemp("home")
    leave_to_draw(home, DRAWN)
    with serving(home, find_free_port(), WHOLE, needs=("workers_alive", "viewer_alive")) as address:
        yield address


@pytest.fixture(scope="session")
def filled_product(tmp_path_factory: pytest.TempPathFactory, find_free_port: Callable[[], int]) -> Generator[str]:
    """Serve page and API over runs that have ended, run and wait; nothing is trained. Return the address."""
    home = tmp_path_factory.mktemp("filled")
    database = open_database(Settings(home=home, database_url=sqlite_url(home)))
    create_study(
        database, "Push and slide", StudySpec(("FetchPush", "FetchSlide"), ("her", "her-sldr"), SEEDS, "quick")
    )
    play_out(database, epochs=20, share_of=lambda claim: 0.6 if claim.config.seed == SEEDS[-1] else 1.0)
    launch(database, LaunchOrder("FetchPush", "manipulation", "ddpg", (0, 1), "quick"))
    database.close()
    with serving(home, find_free_port(), PAGE_AND_API) as address:
        yield address


@pytest.fixture(scope="module")
def printed_address(tmp_path_factory: pytest.TempPathFactory, find_free_port: Callable[[], int]) -> Generator[str]:
    """Serve an empty data directory as `make run` does; return the address that is printed, with its token."""
    home = tmp_path_factory.mktemp("first")
    leave_to_draw(home, DRAWN)
    with serving(home, find_free_port(), WHOLE, needs=("workers_alive", "viewer_alive")):
        yield _printed(home / "serve.log")


def _printed(log: Path) -> str:
    """Wait until the address to open is printed, which comes a moment after the first answer."""
    give_up_at = time.monotonic() + STARTED_WITHIN_S
    while not (found := re.findall(r"http://\S+\?token=\S+", log.read_text())):
        assert time.monotonic() < give_up_at, log.read_text()
        time.sleep(0.1)
    return found[0]

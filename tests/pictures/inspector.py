"""Make the pictures of the demonstration inspector, from trained locomotion models, in headless Chromium.

    make pictures-3d MODELS="runs/a/locomotion.pt runs/b/locomotion.pt"

Each model becomes a run of a service that lives for the pictures only. They go to docs/pictures/inspector-*.png.
"""

from __future__ import annotations

import argparse
import os
import shutil
import socket
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, expect, sync_playwright

sys.path.insert(0, str(Path(__file__).parents[1]))
from conftest import CHROMIUM_ARGUMENTS
from served_product import WHOLE, serving
from signed_in import cookies

from backend.store.database import open_database
from backend.store.files import register_file
from backend.store.launches import LaunchOrder, launch
from backend.store.outcomes import Succeeded
from backend.store.queue import claim, finish
from backend.store.settings import Settings, sqlite_url
from backend.store.storage import checksum
from backend.store.workers import register_worker
from sldr_core.nets.locomotion_model import load_locomotion_model
from sldr_core.training.files import LOCOMOTION_FILE, NEWEST_POLICY_FILE

ROOT = Path(__file__).parents[2]
PATIENCE_MS = 120_000
"""The page is drawn without a graphics card: patience [ms]."""
HEIGHT = 1400
"""Height of the page [px]: all of it, as the scene is drawn again when that changes."""
COLOURS = 128
"""Colours of a picture's palette: the files stay small."""


@dataclass(frozen=True)
class Picture:
    """Say what a picture shows."""

    name: str
    task: str
    """The locomotion task of the model."""
    starts: str
    """Whose starts and goals are drawn."""
    slice: str
    """The slice of Q, as the page names it."""
    step: int
    number: int = 0
    """The demonstration that is shown."""
    part: str = ""
    """Of which object of a stack the slice is."""


PICTURES = (
    Picture("push", "FetchPush", "FetchPush", "value of being elsewhere", step=2, number=2),
    Picture(
        "stack2", "FetchPickAndPlace", "FetchStack2", "value of doing something else", step=1, number=1, part="block 2"
    ),
    Picture("tuple5", "FetchTuple5", "FetchTuple5", "value of doing something else", step=6),
    # HandBlockFull is rewarded by two models, one for the turn and one for the place.
    Picture("block-rotate", "HandBlockRotate", "HandBlockRotate", "value of being turned otherwise", step=6),
    Picture("block-translate", "HandBlockTranslate", "HandBlockTranslate", "value of being elsewhere", step=6),
)


def main() -> int:
    """Make the pictures of the models that are given."""
    parser = argparse.ArgumentParser(description="Make the pictures of the demonstration inspector.")
    parser.add_argument("models", nargs="+", type=Path, metavar="FILE", help="locomotion.pt of a locomotion run")
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "pictures")
    parser.add_argument("--only", nargs="*", default=[], metavar="NAME", help="make these pictures only")
    parser.add_argument("--dark", action="store_true", help="in the dark scheme")
    parser.add_argument("--width", type=int, default=1280, help="width of the page [px]")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as home:
        settings = Settings(Path(home), sqlite_url(Path(home)))
        runs = make_runs(settings, options.models)
        service = serving(settings.home, free_port(), WHOLE, ("viewer_alive", "workers_alive"))
        with service as address, browsing(options.width, options.dark) as page:
            page.context.add_cookies(cookies())  # type: ignore[arg-type]
            for picture in PICTURES:
                if picture.task in runs and (not options.only or picture.name in options.only):
                    page.goto(f"{address}/runs/{runs[picture.task]}?tab=demonstrations")
                    take(page, picture, options.out / f"inspector-{picture.name}.png")
    return 0


def make_runs(settings: Settings, models: Sequence[Path]) -> dict[str, str]:
    """Enter each model as what a finished locomotion run has left; return the runs' ids by task."""
    database, runs = open_database(settings), {}
    worker = register_worker(database, "pictures", 1, 1)
    for path in models:
        model = load_locomotion_model(path)
        config = model.config
        launch(database, LaunchOrder(config.task, "locomotion", config.method, (config.seed,), "quick"))
        held = claim(database, worker)
        assert held is not None
        for name, kind in ((LOCOMOTION_FILE, "locomotion"), (NEWEST_POLICY_FILE, "policy")):
            kept = settings.run_directory(held.run_id) / name
            kept.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, kept)
            place = str(kept.relative_to(settings.home))
            register_file(database, held, name, kind, place, kept.stat().st_size, checksum(kept))
        finish(database, held, Succeeded(model.measured.success_rate))
        runs[config.task] = held.run_id
    database.close()
    return runs


@contextmanager
def browsing(width: int, dark: bool) -> Iterator[Page]:
    """Open a browser page."""
    with sync_playwright() as playwright:
        chromium = os.environ.get("SLDR_CHROMIUM", "/usr/bin/chromium")
        browser = playwright.chromium.launch(executable_path=chromium, args=CHROMIUM_ARGUMENTS)
        page = browser.new_page(
            viewport={"width": width, "height": HEIGHT},
            color_scheme="dark" if dark else "light",
            reduced_motion="reduce",
        )
        page.set_default_timeout(PATIENCE_MS)
        expect.set_options(timeout=PATIENCE_MS)
        yield page
        browser.close()


def take(page: Page, picture: Picture, path: Path) -> None:
    """Drive the inspector to what a picture shows, and take it."""
    page.get_by_role("button", name="Inspect the demonstrations").click()
    # Not a click: a page that draws a moving scene without a graphics card never stands still for one.
    page.get_by_role("button", name="Pause (space)").dispatch_event("click")
    starts = page.get_by_label("Whose starts and goals")
    if picture.starts != picture.task:
        starts.select_option(picture.starts)
    page.get_by_role("button", name="Collect").click()
    expect(page.get_by_role("button", name="Stop")).to_be_visible()
    expect(page.get_by_role("button", name="Collect")).to_be_visible()
    for _ in range(picture.number):
        page.get_by_role("button", name="Next demonstration").click()
    page.get_by_label("Slice of Q").get_by_label("Slice of Q").select_option(label=picture.slice)
    if picture.part:
        page.get_by_label("Object", exact=True).select_option(label=picture.part)
    page.get_by_label("Step", exact=True).and_(page.get_by_role("slider")).fill(str(picture.step))
    expect(page.get_by_role("img", name="Q at this moment")).to_be_visible()
    clear_view(page)
    page.screenshot(path=path, full_page=True, timeout=PATIENCE_MS)
    Image.open(path).convert("RGB").quantize(COLOURS).save(path, optimize=True)
    print(f"{path}: {path.stat().st_size / 1000:.0f} kB", flush=True)
    page.get_by_role("button", name="Close", exact=True).first.click()


def free_port() -> int:
    """Return a port on which nothing listens."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def clear_view(page: Page) -> None:
    """Give the scene time to be drawn, and close what Viser says of software rendering."""
    frame = page.frame_locator("iframe")
    toast = frame.get_by_text("Software WebGL")
    expect(toast).to_be_visible()
    frame.locator(".mantine-Notification-closeButton").first.click()
    expect(toast).to_be_hidden()


if __name__ == "__main__":
    sys.exit(main())

"""The Rerun tab: the viewer comes from our own server, shows the recording, and opens the next one by itself."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass

import pytest
from playwright.sync_api import Page, Response, expect
from served_product import PAGE_AND_API, serving

from backend.store.claims import Claim
from backend.store.database import Database, open_database
from backend.store.files import register_file
from backend.store.launches import LaunchOrder, launch
from backend.store.queue import claim
from backend.store.settings import Settings, sqlite_url
from backend.store.storage import checksum
from sldr_core.records import Step
from worker.recording.content import LogLine, Recording
from worker.recording.rerun_file import write_recording

pytestmark = pytest.mark.browser

SOON_MS = 60_000
"""The viewer has come and is compiled by then, even on a busy machine [ms]."""
DRAWN_BYTES = 8_000
"""A picture of an empty canvas compresses to less than this."""
RECORDING = "recording-attempt-1.rrd"


@dataclass(frozen=True)
class ServedRun:
    """A run that trains, behind an API of its own."""

    address: str
    db: Database
    settings: Settings
    held: Claim

    def record(self, points: int) -> None:
        """Renew the run's recording, as its trainer does."""
        path = self.settings.run_directory(self.held.run_id) / RECORDING
        steps = [Step(at, at, 1000 * at, 10 * at, 20 * at, 1.0 * at) for at in range(1, points + 1)]
        success = {"test/success_rate": [at / points for at in range(points)]}
        write_recording(path, Recording("FetchPush her", steps, success, log=[LogLine(0, "It begins.")]))
        place = str(path.relative_to(self.settings.home))
        register_file(self.db, self.held, RECORDING, "recording", place, path.stat().st_size, checksum(path))


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory, find_free_port: Callable[[], int]) -> Iterator[ServedRun]:
    """Serve the page in front of one run with a recording; nothing is trained."""
    home = tmp_path_factory.mktemp("home")
    settings = Settings(home=home, database_url=sqlite_url(home))
    with closing(open_database(settings)) as db:
        launch(db, LaunchOrder("FetchPush", "manipulation", "her", (0,), "smoke"))
        held = claim(db, "here", lease_s=3600.0)
        assert held is not None
        with serving(home, find_free_port(), PAGE_AND_API) as address:
            run = ServedRun(address, db, settings, held)
            run.record(points=20)
            yield run


def test_the_recording_opens_on_the_page_and_is_renewed(served: ServedRun, page: Page) -> None:
    asked: list[str] = []
    wasm: list[Response] = []
    page.on("request", lambda request: asked.append(request.url))
    page.on("response", lambda response: wasm.append(response) if response.url.endswith(".wasm") else None)

    page.goto(f"{served.address}/runs/{served.held.run_id}")
    expect(page.get_by_role("tab", name="Rerun")).to_be_visible(timeout=SOON_MS)
    assert not [url for url in asked if "re_viewer" in url], "the viewer comes with the first page"
    page.get_by_role("tab", name="Rerun").click()

    shown = page.locator("[data-viewer='shown']")
    expect(shown).to_be_visible(timeout=SOON_MS)
    expect(shown.locator("canvas")).to_be_visible()
    assert page.get_by_text(f"rerun {RECORDING}").is_visible()
    assert len(shown.screenshot(timeout=SOON_MS)) > DRAWN_BYTES

    with page.expect_response(lambda response: "?version=" in response.url, timeout=SOON_MS) as renewed:
        served.record(points=30)
    assert renewed.value.ok
    expect(shown).to_be_visible()

    assert [url for url in asked if not url.startswith((served.address, "data:", "blob:"))] == []
    [compressed] = wasm
    assert compressed.headers["content-encoding"] == "gzip"
    assert "immutable" in compressed.headers["cache-control"]

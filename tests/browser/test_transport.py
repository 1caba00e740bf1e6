"""A recorded episode in the browser: what the bar says is what the scene shows, and what the file holds."""

from __future__ import annotations

import json
import time
from contextlib import closing
from typing import Any

import httpx
import numpy as np
import pytest
from playwright.sync_api import Page, ViewportSize, expect
from signed_in import credentials, get
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin

from sldr_core.episodes import RecordedEpisode, read_episodes

pytestmark = pytest.mark.browser

SOON_MS = 90_000
"""The page shows what it has been asked for by then, even on a busy machine [ms]."""
TRAINED_S = 180.0
"""A smoke run has ended by then, even on a busy machine [s]."""

SMALL: ViewportSize = {"width": 480, "height": 640}
"""Software rendering is slow: a small scene leaves the processor to the page [px]."""

ORDER = {"task": "FetchPush", "phase": "manipulation", "method": "her-sldr", "preset": "smoke", "seeds": [0]}


@pytest.fixture(scope="module")
def run_id(product: str) -> str:
    """Return a smoke run of her-sldr that has succeeded: one that is there already, or a new one."""
    wanted = {"task": "FetchPush", "phase": "manipulation", "method": "her-sldr"}
    known = [run["id"] for run in get(product, "/api/runs")["runs"] if wanted.items() <= run.items()]
    if not known:
        launched = httpx.post(f"{product}/api/launches", json=ORDER, headers=credentials(product)).json()["runs"]
        known = [run["id"] for run in launched if run["phase"] == "manipulation"]
    give_up_at = time.monotonic() + TRAINED_S
    while (state := get(product, f"/api/runs/{known[0]}")["state"]) != "succeeded":
        assert state != "failed"
        assert time.monotonic() < give_up_at, f"the run is still {state}"
        time.sleep(0.5)
    return known[0]


@pytest.fixture(scope="module")
def recorded(product: str, run_id: str, tmp_path_factory: pytest.TempPathFactory) -> tuple[int, RecordedEpisode]:
    """Return the newest recorded epoch and its first episode, downloaded as a person would."""
    files = {file["name"]: file["url"] for file in get(product, f"/api/runs/{run_id}/files")["files"]}
    name = max(name for name in files if name.startswith("episodes-epoch-"))
    path = tmp_path_factory.mktemp("download") / name
    path.write_bytes(httpx.get(f"{product}{files[name]}", headers=credentials(product)).content)
    test = read_episodes(path)
    return test.origin.epoch, test.episodes[0]


def dial(product: str, page: Page) -> ClientConnection:
    """Connect with the session that the page shows, through the proxy, as the page does."""
    address = page.locator("iframe[title='3D view']").get_attribute("src")
    assert address is not None
    control = f"{product}{address.split('?')[0]}control".replace("http", "ws")
    return connect(control, origin=Origin(product), additional_headers=credentials(product), proxy=None)


def report(session: ClientConnection) -> dict[str, Any]:
    session.send(json.dumps({"do": "report", "id": 1}))
    while True:
        message = json.loads(session.recv(SOON_MS / 1000))
        if message.get("id") == 1:
            return message["answer"]


def test_the_bar_and_the_charts_drive_the_scene_to_the_very_state_of_the_file(
    product: str, run_id: str, recorded: tuple[int, RecordedEpisode], page: Page
) -> None:
    epoch, episode = recorded
    page.set_viewport_size(SMALL)
    page.set_default_timeout(SOON_MS)
    page.goto(f"{product}/runs/{run_id}?tab=3d&episode={epoch}.0")
    shown = page.get_by_role("status", name="Step shown")
    expect(shown).to_contain_text(f"0 / {episode.length}", timeout=SOON_MS)
    expect(page.frame_locator("iframe[title='3D view']").locator("canvas").first).to_be_visible(timeout=SOON_MS)
    with closing(dial(product, page)) as session:
        scrub = page.get_by_role("slider", name="Step")
        scrub.fill("23")
        expect(shown).to_contain_text("23 /", timeout=SOON_MS)
        assert report(session)["qpos"] == episode.qpos[23].tolist()

        scrub.evaluate("slider => slider.blur()")
        page.keyboard.press("ArrowRight")
        expect(shown).to_contain_text("24 /", timeout=SOON_MS)
        assert report(session)["qpos"] == episode.qpos[24].tolist()

        q = episode.reward[:, 1:].min(axis=1)
        worst = int(q.argmin())
        expect(page.get_by_role("button", name="Go to the worst q")).to_be_visible(timeout=SOON_MS)
        _click_step(page, "q", worst, episode.length)
        expect(shown).to_contain_text(f"{worst} /", timeout=SOON_MS)
        told = report(session)
        assert told["step"] == worst
        assert not told["playing"]
        assert np.array_equal(told["qpos"], episode.qpos[worst])


def _click_step(page: Page, group: str, step: int, steps: int) -> None:
    """Click into a chart where a step is."""
    over = page.locator(f"figure[data-group='{group}'] .u-over")
    over.scroll_into_view_if_needed(timeout=SOON_MS)
    box = over.bounding_box()
    assert box is not None
    # A pixel inside: the first step lies on the very edge.
    x = min(max(box["width"] * step / steps, 1.0), box["width"] - 1.0)
    over.click(position={"x": x, "y": box["height"] / 2}, timeout=SOON_MS)


def test_a_made_up_episode_is_refused_in_a_sentence(product: str, run_id: str, page: Page) -> None:
    page.goto(f"{product}/runs/{run_id}?tab=3d&episode=99.0")
    expect(page.get_by_text(f"Run {run_id} has no recorded episodes of epoch 99")).to_be_visible(timeout=SOON_MS)

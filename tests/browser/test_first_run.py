"""From a click in the browser to a trained policy that moves in 3D, with everything real."""

from __future__ import annotations

import re
from pathlib import Path

import httpx
import pytest
from playwright.sync_api import Browser, FloatRect, Page, expect
from signed_in import cookies, credentials, get

pytestmark = pytest.mark.browser

SOON_MS = 30_000
"""The page shows what it has been asked for by then, even on a busy machine [ms]."""
DRAWN_MS = 150_000
"""A 3D scene is there by then, drawn without a graphics card beside other tests [ms]."""
PATIENCE = 40
"""Looks at the 3D scene, a second apart, until it is drawn and has moved."""
DRAWN_BYTES = 20_000
"""A picture of an empty scene compresses to less than this."""
TRAINED_MS = 180_000
"""A smoke run has ended by then, even on a busy machine [ms]."""

BADGE = "header [data-state]"
"""The run's own state: other runs that the page names have badges too."""


@pytest.fixture(scope="module")
def run_address(product: str, browser: Browser) -> str:
    """Launch a smoke run of her-sldr through the page; return the address of the manipulation run's page."""
    page = browser.new_page()
    page.context.add_cookies(cookies())  # type: ignore[arg-type]
    outside: list[str] = []
    page.on("request", lambda request: outside.append(request.url) if not request.url.startswith(product) else None)
    page.goto(f"{product}/")
    page.get_by_role("link", name="New run").first.click()
    for choice in ("FetchPush", "her-sldr", "smoke"):
        page.get_by_role("radio", name=choice, exact=True).check(force=True)
    page.get_by_role("button", name=re.compile(r"^Launch 2 runs")).click(timeout=SOON_MS)
    page.wait_for_url(re.compile(r"/runs/\w+|/$|/\?"), timeout=SOON_MS)
    assert [url for url in outside if not url.startswith(("data:", "blob:"))] == []
    page.close()
    runs = get(product, "/api/runs")["runs"]
    manipulation = next(run for run in runs if run["phase"] == "manipulation")
    assert manipulation["state"] in ("blocked", "queued", "running")
    return f"{product}/runs/{manipulation['id']}"


def test_the_task_is_shown_as_a_picture(product: str, page: Page) -> None:
    page.goto(f"{product}/launch")
    picture = page.locator("img").first
    expect(picture).to_be_visible(timeout=SOON_MS)
    # `wait_for_function` would look a second time from within the page, whose policy forbids `eval`.
    expect(picture).not_to_have_js_property("naturalWidth", 0, timeout=SOON_MS)


def test_locomotion_comes_first_and_the_robot_starts_by_itself(run_address: str, page: Page) -> None:
    page.goto(run_address)
    expect(page.locator(BADGE).first).to_have_text("succeeded", timeout=TRAINED_MS)
    address, run_id = run_address.split("/runs/")
    runs = {run["id"]: run for run in get(address, "/api/runs")["runs"]}
    (locomotion_id,) = runs[run_id]["needs"]
    assert runs[locomotion_id]["phase"] == "locomotion"
    assert runs[locomotion_id]["ended_at"] <= runs[run_id]["started_at"]


def test_the_curve_is_drawn(run_address: str, page: Page) -> None:
    page.goto(run_address)
    expect(page.locator(BADGE).first).to_have_text("succeeded", timeout=TRAINED_MS)
    canvas = page.get_by_role("figure", name="Success rate", exact=True).locator("canvas")
    expect(canvas).to_be_visible(timeout=SOON_MS)
    colours = canvas.evaluate(
        """canvas => {
            const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
            const seen = new Set();
            for (let i = 0; i < pixels.length; i += 4) seen.add(`${pixels[i]},${pixels[i+1]},${pixels[i+2]}`);
            return seen.size;
        }"""
    )
    assert colours > 2


def test_the_policy_moves_in_3d(run_address: str, page: Page) -> None:
    page.goto(run_address)
    expect(page.locator(BADGE).first).to_have_text("succeeded", timeout=TRAINED_MS)
    page.get_by_role("tab", name="3D").click()
    page.get_by_role("button", name="Watch the newest policy").click()
    scene = page.frame_locator("iframe[title='3D view']")
    canvas = scene.locator("canvas").first
    expect(canvas).to_be_visible(timeout=DRAWN_MS)
    box = page.locator("iframe[title='3D view']").bounding_box()
    assert box is not None
    # Software rendering draws a few frames a second: wait for pictures, never for a number of frames.
    pictures: set[bytes] = set()
    for _ in range(PATIENCE):
        page.wait_for_timeout(1_000)
        picture = page.screenshot(clip=FloatRect(**box), timeout=2 * SOON_MS)
        if len(picture) > DRAWN_BYTES:
            pictures.add(picture)
        if len(pictures) > 1:
            return
    pytest.fail(f"in {PATIENCE} looks, {len(pictures)} picture(s) of a drawn scene")


def test_the_rerun_file_is_offered(run_address: str, page: Page, tmp_path: Path) -> None:
    page.goto(run_address)
    expect(page.locator(BADGE).first).to_have_text("succeeded", timeout=TRAINED_MS)
    page.get_by_role("tab", name="Files").click()
    with page.expect_download(timeout=SOON_MS) as download:
        page.get_by_role("link", name=re.compile(r"recording-attempt-1\.rrd")).first.click()
    saved = tmp_path / "recording.rrd"
    download.value.save_as(saved)
    assert saved.read_bytes()[:4] == b"RRF2"


def test_an_impossible_setting_is_refused_at_its_field(product: str, page: Page) -> None:
    page.goto(f"{product}/launch")
    answer = httpx.post(
        f"{product}/api/launches/plan",
        headers=credentials(product),
        json={
            "task": "FetchPush",
            "phase": "manipulation",
            "method": "her",
            "seeds": [0],
            "preset": "smoke",
            "overrides": {"loop": {"batch_size": -1}},
        },
    )
    assert answer.status_code == 422
    assert answer.json()["problems"][0]["field"] == "loop.batch_size"


def test_a_run_that_does_not_exist_gets_one_sentence(product: str, page: Page) -> None:
    page.goto(f"{product}/runs/nope")
    expect(page.get_by_text(re.compile("no run", re.IGNORECASE)).first).to_be_visible(timeout=SOON_MS)
    assert "Traceback" not in page.content()

"""The first minutes of a server that asks for accounts, in a real browser."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import pytest
from playwright.sync_api import BrowserContext, Page, expect
from served_product import PAGE_AND_API, serving

from backend.store.access.entry import greet
from backend.store.settings import Settings, sqlite_url

pytestmark = pytest.mark.browser

PASSWORD_LABEL = re.compile("^Password")
"""A label of something required ends in an asterisk."""

SOON_MS = 60_000
"""The page shows what it has been asked for by then, even on a busy machine [ms]."""
PASSWORD = "seven purple otters"


@dataclass(frozen=True)
class Opened:
    """A server that asks for accounts, and the link for its first admin."""

    address: str
    link: str


@pytest.fixture(scope="module")
def opened(tmp_path_factory: pytest.TempPathFactory, find_free_port: Callable[[], int]) -> Iterator[Opened]:
    """Serve an empty data directory to accounts."""
    home = tmp_path_factory.mktemp("accounts")
    settings = Settings(home=home, database_url=sqlite_url(home))
    with serving(home, find_free_port(), PAGE_AND_API, options=("--accounts",)) as address:
        yield Opened(address, greet(settings, address, "accounts").split()[-1])


@pytest.fixture
def context(new_context: Callable[..., BrowserContext]) -> BrowserContext:
    """Return a browser that nobody is signed in with."""
    return new_context()


def test_the_first_admin_lets_somebody_in_and_both_sign_in(
    opened: Opened, page: Page, new_context: Callable[..., BrowserContext]
) -> None:
    refused: list[str] = []
    page.on("console", lambda line: refused.append(line.text) if "Content Security Policy" in line.text else None)
    page.goto(opened.address)
    expect(page.get_by_role("heading", name="Sign in")).to_be_visible(timeout=SOON_MS)

    _set_password(page, opened.link, "Welcome, admin")
    page.get_by_role("link", name="Account").click(timeout=SOON_MS)
    page.get_by_role("link", name="All accounts and audit log").click(timeout=SOON_MS)
    page.get_by_label("Name of the new account").fill("ada")
    page.get_by_role("button", name="Add and make its link").click()
    link = page.locator("code", has_text="/welcome#").inner_text(timeout=SOON_MS)

    hers = new_context().new_page()
    _set_password(hers, link, "Welcome, ada")
    hers.goto(f"{opened.address}/account")
    hers.get_by_role("button", name="Sign out").click(timeout=SOON_MS)
    hers.get_by_label("Name").fill("ada", timeout=SOON_MS)
    hers.get_by_label(PASSWORD_LABEL).fill(PASSWORD)
    hers.get_by_role("button", name="Sign in").click()
    expect(hers.get_by_role("heading", name="Runs")).to_be_visible(timeout=SOON_MS)

    page.reload()
    log = page.get_by_role("table", name="Audit log")
    expect(log.get_by_text("add account")).to_be_visible(timeout=SOON_MS)
    assert refused == []


def _set_password(page: Page, link: str, greeting: str) -> None:
    page.goto(link)
    expect(page.get_by_role("heading", name=greeting)).to_be_visible(timeout=SOON_MS)
    assert "#" not in page.url
    page.get_by_label(PASSWORD_LABEL).fill(PASSWORD)
    page.get_by_label("Once more").fill(PASSWORD)
    page.get_by_role("button", name="Set it and sign in").click()
    expect(page.get_by_role("heading", name="Runs")).to_be_visible(timeout=SOON_MS)

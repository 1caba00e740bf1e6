"""`sldr accounts`: the way back in for whoever runs the server."""

from __future__ import annotations

from contextlib import closing

import pytest
from command_line import run, use

from backend.store.access.accounts import list_accounts
from backend.store.access.audit import list_entries
from backend.store.access.invitations import accept
from backend.store.database import Database, open_database
from backend.store.settings import Settings


@pytest.fixture
def db(settings: Settings, monkeypatch: pytest.MonkeyPatch):
    use(settings, monkeypatch)
    with closing(open_database(settings)) as db:
        yield db


def test_an_account_is_made_with_a_link_that_opens_it(db: Database, capsys: pytest.CaptureFixture[str]) -> None:
    code, said, _ = run(capsys, "accounts", "--invite", "ada", "--role", "admin")
    assert code == 0
    accept(db, said.partition("/welcome#")[2].split()[0], "hash")
    assert [(account.name, account.role, account.has_password) for account in list_accounts(db)] == [
        ("ada", "admin", True)
    ]
    assert "waits for its link" in said
    assert run(capsys, "accounts")[1].split() == ["ada", "admin", "open"]
    [entry] = list_entries(db, 9)
    assert (entry.deed.who, entry.deed.target) == ("command line", "ada")


def test_an_account_is_closed_and_opened_again(db: Database, capsys: pytest.CaptureFixture[str]) -> None:
    run(capsys, "accounts", "--invite", "bob")
    assert "closed" in run(capsys, "accounts", "--close", "bob")[1]
    assert "waits" in run(capsys, "accounts", "--invite", "bob")[1].splitlines()[-1]


@pytest.mark.parametrize(
    ("arguments", "sentence"), [(("--close", "eve"), "no account 'eve'"), (("--invite", "No One"), "cannot be a name")]
)
def test_a_wrong_name_is_told(
    db: Database, capsys: pytest.CaptureFixture[str], arguments: tuple[str, str], sentence: str
) -> None:
    code, _, complaint = run(capsys, "accounts", *arguments)
    assert code == 2
    assert sentence in complaint

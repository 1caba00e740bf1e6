"""Accounts, one-time links, sessions, tokens and the audit log."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest
from sqlalchemy import select, update

from backend.store.access import accounts, api_tokens, invitations, login_sessions
from backend.store.access.accounts import Account, AccountChange
from backend.store.access.audit import AUDIT_KEPT, Deed, forget_old_entries, list_entries, write_entry
from backend.store.access.tables import api_tokens as token_table
from backend.store.access.tables import audit_log
from backend.store.access.tables import invitations as invitation_table
from backend.store.access.tables import login_sessions as session_table
from backend.store.database import Database
from backend.store.errors import NotFound, Refused

HASH = "$argon2id$v=19$m=8,t=1,p=1$c2FsdHNhbHQ$aGFzaA"
LONG_AGO = datetime(2020, 1, 1, tzinfo=UTC)


@pytest.fixture
def ada(db: Database) -> Account:
    """Return an admin who can sign in."""
    account = accounts.create_account(db, "ada", "admin")
    accounts.set_password(db, account.id, HASH)
    return accounts.get_account(db, account.id)


def everything_stored(db: Database) -> str:
    with db.read() as conn:
        tables = (session_table, token_table, invitation_table, audit_log)
        return str([conn.execute(select(table)).all() for table in tables])


def test_a_name_is_given_once(db: Database, ada: Account) -> None:
    with pytest.raises(Refused, match="'ada' already"):
        accounts.create_account(db, "ada", "viewer")
    assert [account.name for account in accounts.list_accounts(db)] == ["ada"]


def test_an_account_without_a_password_or_closed_cannot_sign_in(db: Database, ada: Account) -> None:
    bob = accounts.create_account(db, "bob", "viewer")
    assert accounts.find_password(db, "bob") is None
    accounts.set_password(db, bob.id, HASH)
    assert accounts.find_password(db, "bob") == (accounts.get_account(db, bob.id), HASH)
    accounts.change_account(db, bob.id, AccountChange(disabled=True))
    assert accounts.find_password(db, "bob") is None
    assert accounts.change_account(db, bob.id, AccountChange(disabled=False)).disabled_at is None
    assert accounts.find_password(db, "nobody-here") is None


@pytest.mark.parametrize("change", [AccountChange(role="viewer"), AccountChange(disabled=True)])
def test_the_last_admin_stays_admin(db: Database, ada: Account, change: AccountChange) -> None:
    accounts.create_account(db, "eve", "admin")  # has not opened her link
    with pytest.raises(Refused, match="only admin"):
        accounts.change_account(db, ada.id, change)
    assert accounts.get_account(db, ada.id) == ada


def test_the_first_admin_is_invited_until_there_is_one(db: Database) -> None:
    first = invitations.invite_first_admin(db)
    second = invitations.invite_first_admin(db)
    assert first is not None
    assert second is not None
    with pytest.raises(Refused):
        invitations.find_invited(db, first)  # each link replaces the one before
    assert invitations.accept(db, second, HASH).role == "admin"
    assert invitations.invite_first_admin(db) is None


def test_a_link_opens_once(db: Database, ada: Account) -> None:
    token, ends_at = invitations.invite(db, ada.id)
    assert ends_at > datetime.now(UTC)
    assert invitations.find_invited(db, token).name == "ada"
    invitations.accept(db, token, HASH + "2")
    assert accounts.find_password(db, "ada") == (ada, HASH + "2")
    for again in (invitations.find_invited, lambda db, token: invitations.accept(db, token, HASH)):
        with pytest.raises(Refused, match="used already"):
            again(db, token)


def test_a_link_ends(db: Database, ada: Account) -> None:
    token, _ = invitations.invite(db, ada.id)
    with db.write() as conn:
        conn.execute(update(invitation_table).values(expires_at=LONG_AGO))
    with pytest.raises(Refused):
        invitations.find_invited(db, token)
    with pytest.raises(NotFound):
        invitations.invite(db, "nobody")


def test_a_closed_account_gets_no_link_that_would_open_nothing(db: Database) -> None:
    bob = accounts.create_account(db, "bob", "viewer")
    accounts.change_account(db, bob.id, accounts.AccountChange(disabled=True))
    with pytest.raises(Refused, match="'bob' is closed; open it again first"):
        invitations.invite(db, bob.id)


def test_a_new_password_by_link_ends_every_session(db: Database, ada: Account) -> None:
    _, secret = login_sessions.start_session(db, ada.id, "10.0.0.7", "Firefox")
    token, _ = invitations.invite(db, ada.id)
    assert login_sessions.find_session(db, secret) is not None
    invitations.accept(db, token, HASH)
    assert login_sessions.find_session(db, secret) is None


def test_who_signed_in_may_read_while_somebody_else_writes_for_long(db: Database, ada: Account) -> None:
    session, secret = login_sessions.start_session(db, ada.id, "10.0.0.7", "Firefox")
    _, token = api_tokens.create_token(db, ada.id, "laptop", "viewer", None)
    with db.write() as conn:
        conn.execute(update(session_table).values(seen_at=session.seen_at - timedelta(hours=5)))

    with db.write():
        assert login_sessions.find_session(db, secret) is not None
        assert api_tokens.find_token(db, token) is not None


@pytest.mark.parametrize("column", ["expires_at", "seen_at", "ended_at"])
def test_a_session_ends(db: Database, ada: Account, column: str) -> None:
    session, secret = login_sessions.start_session(db, ada.id, "10.0.0.7", "Firefox")
    assert login_sessions.find_session(db, secret) == (session, ada)
    with db.write() as conn:
        conn.execute(update(session_table).values({column: LONG_AGO}))
    assert login_sessions.find_session(db, secret) is None
    assert login_sessions.list_sessions(db, ada.id) == []


def test_a_session_that_is_used_lives_on_and_is_touched_once_a_minute(db: Database, ada: Account) -> None:
    session, secret = login_sessions.start_session(db, ada.id, "10.0.0.7", "Firefox")
    assert login_sessions.find_session(db, secret) is not None
    [seen] = login_sessions.list_sessions(db, ada.id)
    assert seen.seen_at == session.seen_at
    earlier = session.seen_at - timedelta(hours=5)
    with db.write() as conn:
        conn.execute(update(session_table).values(seen_at=earlier))
    assert login_sessions.find_session(db, secret) is not None
    [seen] = login_sessions.list_sessions(db, ada.id)
    assert seen.seen_at > earlier


def test_sessions_with_and_without_an_account_are_kept_apart(db: Database, ada: Account) -> None:
    own, _ = login_sessions.start_session(db, ada.id, "10.0.0.7", "x" * 500)
    local, _ = login_sessions.start_session(db, None, "127.0.0.1", "Firefox")
    assert [session.id for session in login_sessions.list_sessions(db, ada.id)] == [own.id]
    assert [session.id for session in login_sessions.list_sessions(db, None)] == [local.id]
    with pytest.raises(NotFound):
        login_sessions.end_session(db, ada.id, local.id)
    kept, _ = login_sessions.start_session(db, ada.id, "10.0.0.8", "Firefox")
    login_sessions.end_other_sessions(db, ada.id, kept.id)
    assert [session.id for session in login_sessions.list_sessions(db, ada.id)] == [kept.id]
    assert len(login_sessions.list_sessions(db, None)) == 1


def test_a_closed_account_opens_nothing(db: Database, ada: Account) -> None:
    bob = accounts.create_account(db, "bob", "operator")
    _, secret = login_sessions.start_session(db, bob.id, "10.0.0.7", "Firefox")
    _, token = api_tokens.create_token(db, bob.id, "notebook", "viewer", None)
    accounts.change_account(db, bob.id, AccountChange(disabled=True))
    assert login_sessions.find_session(db, secret) is None
    assert api_tokens.find_token(db, token) is None


def test_a_token_is_valid_until_it_ends_or_is_revoked(db: Database, ada: Account) -> None:
    made, secret = api_tokens.create_token(db, ada.id, "notebook", "viewer", timedelta(days=1))
    found = api_tokens.find_token(db, secret)
    assert found == (made, ada)
    assert api_tokens.list_tokens(db, ada.id)[0].used_at is not None
    with pytest.raises(NotFound):
        api_tokens.revoke_token(db, None, made.id)
    api_tokens.revoke_token(db, ada.id, made.id)
    assert api_tokens.find_token(db, secret) is None
    _, secret = api_tokens.create_token(db, ada.id, "short", "viewer", timedelta(days=-1))
    assert api_tokens.find_token(db, secret) is None


def test_an_account_has_so_many_tokens_at_most(db: Database, ada: Account, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(api_tokens, "TOKENS_AT_MOST", 1)
    api_tokens.create_token(db, ada.id, "one", "viewer", None)
    with pytest.raises(Refused, match="revoke one"):
        api_tokens.create_token(db, ada.id, "two", "viewer", None)


def test_no_secret_is_stored(db: Database, ada: Account) -> None:
    _, session = login_sessions.start_session(db, ada.id, "10.0.0.7", "Firefox")
    _, token = api_tokens.create_token(db, ada.id, "notebook", "viewer", None)
    link, _ = invitations.invite(db, ada.id)
    stored = everything_stored(db)
    assert not [secret for secret in (session, token, link) if secret in stored]


def test_the_audit_log_is_read_page_by_page_and_forgets(db: Database) -> None:
    for number in range(5):
        write_entry(db, Deed("ada" if number % 2 else "bob", f"act {number}", "10.0.0.7", "done"))
    newest = list_entries(db, 2)
    assert [entry.deed.action for entry in newest] == ["act 4", "act 3"]
    assert [entry.deed.action for entry in list_entries(db, 9, before=newest[-1].id)] == ["act 2", "act 1", "act 0"]
    assert [entry.deed.action for entry in list_entries(db, 9, who="ada")] == ["act 3", "act 1"]
    assert list_entries(db, 9, outcome="refused") == []
    with db.write() as conn:
        past = datetime.now(UTC) - AUDIT_KEPT - timedelta(days=1)
        conn.execute(update(audit_log).where(audit_log.c.who == "ada").values(at=past))
    assert forget_old_entries(db) == 2
    assert {entry.deed.who for entry in list_entries(db, 9)} == {"bob"}


def test_the_audit_log_takes_what_no_column_does(db: Database) -> None:
    write_entry(db, Deed("a\x00b", "x" * 999, "\ud800", "refused", "\x00", "y" * 5000))
    [entry] = list_entries(db, 1)
    assert entry.deed.who == "a\\x00b"
    assert len(entry.deed.action) == 200

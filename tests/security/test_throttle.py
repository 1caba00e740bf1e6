"""Ten thousand attempts to sign in: nearly all cost the server nothing, and the one who belongs there still gets in."""

from __future__ import annotations

import pytest
from guarded_api import PASSWORD, Guarded

from backend.api.access.throttle import (
    ACCOUNT_FAILURES,
    ADDRESS_FAILURES,
    MOST_KEYS,
    WINDOW_S,
    Throttle,
    network_of,
)
from backend.store.access.audit import list_entries

ATTEMPTS = 10_000


class Clock:
    """A clock that is set by hand."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def test_of_ten_thousand_attempts_at_one_account_ten_are_looked_at():
    throttle = Throttle(Clock())
    admitted = sum(throttle.admit("ada", f"10.0.{n // 250}.{n % 250}") == 0 for n in range(ATTEMPTS))
    assert admitted == ACCOUNT_FAILURES


def test_of_ten_thousand_attempts_from_one_address_fifty_are_looked_at():
    throttle = Throttle(Clock())
    admitted = sum(throttle.admit(f"account-{n}", "10.0.0.7") == 0 for n in range(ATTEMPTS))
    assert admitted == ADDRESS_FAILURES


def test_a_day_of_patient_attempts_gets_no_further_than_the_window_allows():
    clock = Clock()
    throttle = Throttle(clock)
    admitted = 0
    for _ in range(ATTEMPTS):
        clock.now += 86_400 / ATTEMPTS
        admitted += throttle.admit("ada", "10.0.0.7") == 0
    assert admitted <= ACCOUNT_FAILURES * (86_400 / WINDOW_S + 1)


def test_after_the_pause_that_was_told_the_next_attempt_is_admitted():
    clock = Clock()
    throttle = Throttle(clock)
    for _ in range(ACCOUNT_FAILURES):
        clock.now += 1.0
        assert throttle.admit("ada", "10.0.0.7") == 0
    pause_s = throttle.admit("ada", "10.0.0.8")
    assert pause_s == WINDOW_S - (ACCOUNT_FAILURES - 1)
    clock.now += pause_s
    assert throttle.admit("ada", "10.0.0.8") == 0


def test_whoever_signs_in_well_is_never_slowed_down():
    throttle = Throttle(Clock())
    for _ in range(ATTEMPTS):
        assert throttle.admit("ada", "10.0.0.7") == 0
        throttle.forgive("ada", "10.0.0.7")


def test_what_is_remembered_stays_small():
    throttle = Throttle(Clock())
    for n in range(MOST_KEYS + 1000):
        throttle.admit(None, f"2001:db8:{n >> 16:x}:{n & 0xFFFF:x}::1")
    assert len(throttle._failures) <= MOST_KEYS  # pyright: ignore[reportPrivateUsage]


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("2001:db8:1:2::1", "2001:db8:1:2:ffff::9", True),
        ("2001:db8:1:2::1", "2001:db8:1:3::1", False),
        ("::ffff:10.0.0.7", "10.0.0.7", True),
        ("10.0.0.7", "10.0.0.8", False),
    ],
)
def test_an_address_stands_for_a_machine(one: str, other: str, same: bool):
    assert (network_of(one) == network_of(other)) == same


def test_wrong_passwords_are_answered_alike_then_with_a_pause_and_all_of_it_is_logged(api: Guarded):
    known = [attempt(api, "viewer") for _ in range(ACCOUNT_FAILURES)]
    unknown = attempt(api, "no-such-account")
    assert {(answer.status_code, answer.text) for answer in [*known, unknown]} == {(403, known[0].text)}
    assert attempt(api, "viewer").status_code == 429
    assert attempt(api, "viewer", PASSWORD).status_code == 429
    api.sign_in("operator")
    written = [entry.deed for entry in list_entries(api.database, 100, outcome="refused")]
    assert sum(deed.who == "viewer" and deed.action == "sign in" for deed in written) >= ACCOUNT_FAILURES
    assert any(deed.detail == "POST, answered 429" for deed in written)


def attempt(api: Guarded, name: str, password: str = "wrong horse battery"):
    return api.browser().post("/api/auth/sign-in", json={"name": name, "password": password})

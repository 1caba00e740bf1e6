"""What benchmarks make of their numbers: medians, ratios, verdicts, lines and what is told of a peer."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import bench_reaching
import pytest
import sac_peer
from bench_epoch import Epoch
from bench_quality import Finished, compare_quality, is_as_its_preset, measure_quality
from bench_rows import Measured, Pairs, Stopwatch, Target, row, seconds_until
from bench_service import with_imports
from kept_results import KeptGroup, as_tables, keep_each, keep_results, read_results
from sac_peer import PeerCurve

from backend.store.database import Database
from backend.store.launches import LaunchOrder, launch
from backend.store.run_filter import RunFilter
from backend.store.runs import list_runs

INFINITY = float("inf")


def test_a_row_is_the_median_of_its_repetitions() -> None:
    measured = row("speed", "x", [3.0, 1.0, 2.0, 9.0, 4.0], Target("at least", 2.5), "")
    assert (measured.value, measured.low, measured.high, measured.is_met) == (3.0, 1.0, 9.0, True)
    assert measured.as_json()["met"] is True


@pytest.mark.parametrize(
    ("target", "value", "met"),
    [
        (Target("at least", 5.0), 5.0, True),
        (Target("at least", 5.0), 4.9, False),
        (Target("at most", 5.0), 5.0, True),
        (Target("at most", 5.0), 5.1, False),
    ],
)
def test_a_target_is_met_at_its_limit(target: Target, value: float, met: bool) -> None:
    assert target.is_met(value) is met


def test_ratios_are_taken_pair_by_pair() -> None:
    pairs = Pairs(ours=[1.0, 2.0], theirs=[4.0, 3.0])
    assert (pairs.speedups, pairs.costs) == ([4.0, 1.5], [0.25, pytest.approx(2 / 3)])


def test_a_stopwatch_adds_up_and_hands_on(monkeypatch: pytest.MonkeyPatch) -> None:
    times = iter([1.0, 3.5, 10.0, 10.25])
    monkeypatch.setattr("time.perf_counter", lambda: next(times))
    watch = Stopwatch()
    timed = watch.around(lambda value: value + 1)
    assert (timed(1), timed(2), watch.total_s) == (2, 3, 2.75)


def test_learning_time_is_that_of_the_first_test_that_is_good_enough() -> None:
    assert seconds_until(0.9, [10.0, 20.0, 30.0], [0.5, 0.9, 1.0]) == 20.0
    assert seconds_until(0.9, [10.0], [0.5]) == INFINITY


def _curve(*success: float) -> PeerCurve:
    count = len(success)
    return PeerCurve(
        "FetchPush", "here", 600.0, [5_000 * (i + 1) for i in range(count)], [60.0 * (i + 1) for i in range(count)],
        list(success), True,
    )  # fmt: skip


def test_a_peer_that_has_learnt_is_compared_with_its_time() -> None:
    reached = [bench_reaching.Reached(12.0, 1.0), bench_reaching.Reached(6.0, 1.0), bench_reaching.Reached(INFINITY, 0)]
    measured = bench_reaching.against_peer("FetchPush", reached, _curve(0.2, 0.94), 10.0)
    assert (measured.value, measured.low, measured.high) == (10.0, 0.0, 20.0)
    assert measured.detail == "the peer came to 94% after 2 min and 10,000 steps"
    assert measured.as_json()["curve"] == {"steps": [5_000, 10_000], "seconds": [60.0, 120.0], "success": [0.2, 0.94]}


def test_no_more_is_asked_of_a_peer_than_its_two_hours_can_show() -> None:
    assert bench_reaching.times_wanted(5.0) == 10.0
    assert bench_reaching.times_wanted(25.0) == pytest.approx(4.8)


def test_a_peer_that_has_not_learnt_counts_with_all_its_time() -> None:
    measured = bench_reaching.against_peer("FetchPush", [bench_reaching.Reached(60.0, 1.0)], _curve(0.2, 0.3), 10.0)
    assert measured.value == 10.0
    assert "stood at 30% after 2 min and 10,000 steps, so it takes longer yet" in measured.detail
    assert _curve().told(0.9) == "the peer was not tested within 10 min"


@pytest.fixture
def sittings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[tuple[float, float]]:
    """Let peers come to 50 % in no time; return what each had spent before and may spend."""
    trained: list[tuple[float, float]] = []

    def train(_env_id: str, _rate: float, curve: PeerCurve, _keep: object) -> None:
        trained.append((curve.spent_s, curve.cap_s))
        curve.steps.append(5_000)
        curve.seconds.append(curve.cap_s - 1.0)
        curve.success.append(0.5)
        curve.spent_s = curve.cap_s
        (tmp_path / "FetchPush").mkdir(exist_ok=True)
        (tmp_path / "FetchPush" / sac_peer.REPLAY).touch()

    monkeypatch.setattr(sac_peer, "KEPT", tmp_path / "build" / "peers.json")
    monkeypatch.setattr(sac_peer, "SAVED", tmp_path)
    monkeypatch.setattr(sac_peer, "_train", train)
    return trained


def test_a_kept_peer_is_trained_again_unless_it_is_asked_for(sittings: list[tuple[float, float]]) -> None:
    first = sac_peer.train_peer("FetchPush", "FetchPush-v4", 0.9, 60.0, take_kept=True)
    assert sac_peer.train_peer("FetchPush", "FetchPush-v4", 0.9, 60.0, take_kept=True) == first
    assert sittings == [(0.0, 60.0)]
    sac_peer.train_peer("FetchPush", "FetchPush-v4", 0.9, 60.0, take_kept=False)
    assert sittings == [(0.0, 60.0), (0.0, 60.0)]


def test_a_kept_peer_goes_on_if_it_may_take_longer_now(sittings: list[tuple[float, float]]) -> None:
    sac_peer.train_peer("FetchPush", "FetchPush-v4", 0.9, 60.0, take_kept=True)
    longer = sac_peer.train_peer("FetchPush", "FetchPush-v4", 0.9, 100.0, take_kept=True)
    assert sittings == [(0.0, 60.0), (60.0, 100.0)]
    assert (longer.cap_s, longer.seconds, longer.is_over) == (100.0, [59.0, 99.0], True)
    assert sac_peer.train_peer("FetchPush", "FetchPush-v4", 0.5, 200.0, take_kept=True) == longer


def test_a_kept_peer_begins_anew_where_it_was_not_saved(tmp_path: Path, sittings: list[tuple[float, float]]) -> None:
    sac_peer.train_peer("FetchPush", "FetchPush-v4", 0.9, 60.0, take_kept=True)
    (tmp_path / "FetchPush" / sac_peer.REPLAY).unlink()
    longer = sac_peer.train_peer("FetchPush", "FetchPush-v4", 0.9, 100.0, take_kept=True)
    assert (sittings[-1], longer.seconds) == ((0.0, 100.0), [99.0])


def test_an_epoch_tells_where_the_rest_of_it_goes() -> None:
    parts = {"physics": 40.0, "learning": 50.0, "observing": 43.0, "acting": 2.0}
    epoch = Epoch(100.0, parts)
    assert epoch.outside == pytest.approx(10.0)
    assert epoch.shares_outside() == pytest.approx({"observing": 3.0, "acting": 2.0, "else": 5.0})


def test_quality_is_compared_with_the_lower_quartile(capsys: pytest.CaptureFixture[str]) -> None:
    ended = {
        ("paper", "float32"): [0.80, 0.90, 1.00, 0.85, 0.95],
        ("quick", "float32"): [0.84, 0.86, 1.00],
        ("paper", "bfloat16"): [0.5, 0.6, 0.99],
        ("quick", "bfloat16"): [0.99],
    }
    runs = {settings: [Finished(rate, len(rates)) for rate in rates] for settings, rates in ended.items()}
    compared = {measured.what: measured for measured in compare_quality({("FetchPush", "her"): runs})}
    quick = compared["FetchPush, her, `quick` in float32: test success"]
    assert quick.target is not None
    assert (quick.value, quick.target.value, quick.is_met) == (pytest.approx(86.0), pytest.approx(85.0), True)
    assert quick.detail == "`paper` in float32: 90.0 % (85.0 to 95.0), 5 and 3 seeds of at most 5 and 3 epochs"
    assert not compared["FetchPush, her, `paper` in bfloat16: test success"].is_met
    assert len(compared) == 2
    assert "`quick` in bfloat16 has 1 runs, `paper` in float32 has 5" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("overrides", "is_so"),
    [
        ({}, True),
        ({"loop": {"epochs": 12, "stop_at_success": 0.95, "stop_after_tests": 2}, "compute": {"threads": 1}}, True),
        ({"loop": {"batch_size": 256}}, False),
        ({"agent": {"learning_rate": 0.1}}, False),
    ],
)
def test_only_runs_with_the_settings_of_their_preset_count(
    db: Database, overrides: Mapping[str, Any], is_so: bool
) -> None:
    launch(db, LaunchOrder("FetchPush", "manipulation", "her", [0], "paper", overrides))
    [run] = list_runs(db, RunFilter(), 1).rows
    assert is_as_its_preset(run) is is_so


def test_the_first_page_weighs_what_it_imports_at_once(tmp_path: Path) -> None:
    files = {name: tmp_path / name for name in ("entry.js", "frame.js", "used.js", "later.js", "style.css")}
    files["entry.js"].write_text('import{a}from"./frame.js";import"./used.js";const b=()=>import("./later.js");')
    files["frame.js"].write_text('import{c}from"./used.js";export*from"./entry.js";')
    files["used.js"].write_text("")
    expected = {files[name] for name in ("entry.js", "frame.js", "used.js", "style.css")}
    assert with_imports([files["entry.js"], files["style.css"]]) == expected


def test_quality_without_a_store_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert list(measure_quality(tmp_path)) == []
    assert f"no store in {tmp_path}" in capsys.readouterr().out
    assert not (tmp_path / "sldr.db").exists()


def test_groups_are_kept_and_told_in_their_order_with_day_and_machine(tmp_path: Path) -> None:
    short = row("speed", "x", [1.5, 2.0, 1.0], Target("at least", 2.0), "1 against 2")
    curve = row("time", "min", [4.0], Target("at most", 5.0), "", {"steps": [5_000.0], "success": [0.2]})
    results = {
        "later": KeptGroup("2026-01-02", "2 cores", (curve,)),
        "first": KeptGroup("2026-01-02", "2 cores", (short,)),
        "other": KeptGroup("2026-01-03", "8 cores", (short,)),
    }
    path = tmp_path / "build" / "bench.json"
    assert read_results(path) == {}
    keep_results(path, results)
    assert read_results(path) == results
    told = as_tables(read_results(path), ["first", "absent", "later", "other"])
    assert [part for part in told if part.startswith("Measured")] == [
        "Measured on 2026-01-02: 2 cores.",
        "Measured on 2026-01-03: 8 cores.",
    ]
    assert [part.splitlines()[2].split(" | ")[0] for part in told if part.startswith("|")] == [
        "| speed",
        "| time",
        "| speed",
    ]
    assert "| at least 2 x | **1.5 x** (1 to 2) | SHORT | 1 against 2 |" in told[1]


def test_a_row_that_tells_how_something_grows_is_neither_met_nor_short(tmp_path: Path) -> None:
    path = tmp_path / "bench.json"
    grown = KeptGroup("2026-01-02", "2 cores", (row("an update at 512", "x", [0.1], None, "17 against 170 ms"),))
    keep_results(path, {"growth": grown})
    assert read_results(path) == {"growth": grown}
    assert grown.rows[0].is_met
    assert "| none | **0.1 x** (0.1 to 0.1) |  | 17 against 170 ms |" in as_tables({"growth": grown}, ["growth"])[1]


def test_a_row_is_kept_before_the_next_one_is_measured(tmp_path: Path) -> None:
    path = tmp_path / "bench.json"
    before, other, new = (row(name, "x", [1.0], Target("at least", 2.0), "") for name in ("before", "other", "new"))
    old = KeptGroup("2026-01-02", "2 cores", (before, before))
    keep_results(path, {"group": old, "others": KeptGroup("2026-01-02", "2 cores", (other,))})

    def measure() -> Iterator[Measured]:
        assert read_results(path)["group"] == old
        yield new
        raise TimeoutError

    with pytest.raises(TimeoutError):
        list(keep_each(path, "group", measure()))

    kept = read_results(path)
    assert kept["group"].rows == (new,)
    assert kept["others"].rows == (other,)

"""The attacks of `make chaos` at a small size: nothing is lost, nothing done twice, nobody locked out."""

from __future__ import annotations

from pathlib import Path

import pytest
from chaos_claims import measure_claims
from chaos_crowd import Crowd, press
from chaos_evidence import Witness, complaints
from chaos_kills import Attack, attack
from chaos_table import Finding, as_markdown, as_text
from chaos_training import METRIC, expected_curve
from measured_page import END, begin_mark, write_results
from store_engines import ENGINES

from backend.store.claims import Claim
from backend.store.database import open_database
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import MetricPoint, append_metrics
from backend.store.outcomes import Lost, Succeeded
from backend.store.queue import claim, finish
from backend.store.settings import Settings
from backend.store.tables import metric_values
from sldr_core.records import Step

SEED = 5


def test_runs_end_as_if_nobody_had_killed_anything(settings: Settings) -> None:
    order = Attack(
        runs=3, kills=4, workers=2, gap_s=0.7, real=False, seed=SEED, lease_s=4.0, cycle_s=0.15, patience_s=240.0
    )

    finding = attack(settings, order, print)

    assert finding.complaints == []


def test_a_crowd_at_one_store_locks_nobody_out(settings: Settings) -> None:
    order = Crowd(seconds=1.5, apis=2, workers=2, clients=2, seed=SEED, cycles=10)

    finding = press(settings, order, print)

    assert [complaint for complaint in finding.complaints if "No run" not in complaint] == []


@pytest.mark.parametrize("engine", ENGINES, scope="module")
def test_each_run_of_a_long_queue_is_claimed_once(settings: Settings) -> None:
    finding = measure_claims(settings, queued=120, claimers=3, say=print)

    assert finding.complaints == []
    assert dict(finding.rows)["queued runs"] == "120"


def log(db, held: Claim, cycles: list[int], curve: list[float]) -> None:
    points = [MetricPoint(Step(cycle, 1, 0, 0, 0, 0.0), {METRIC: curve[cycle - 1]}) for cycle in cycles]
    append_metrics(db, held, points)


@pytest.mark.parametrize(
    ("crime", "complaint"),
    [
        (None, None),
        ("wrong number", "differs from that of an undisturbed run"),
        ("lost number", "1 numbers that were stored are gone"),
        ("gap", "its cycles are"),
        ("unfinished", "is running"),
    ],
)
def test_what_must_not_be_is_found(settings: Settings, crime: str | None, complaint: str | None) -> None:
    db = open_database(settings)
    (run_id,) = launch(db, LaunchOrder("FetchPush", "manipulation", "her", [3], "smoke"))
    curve = expected_curve(3, 3)
    witness = Witness(db, [run_id])
    first = claim(db, "a")
    assert first is not None
    log(db, first, [1, 2], curve)
    witness.look()
    finish(db, first, Lost("Its process was killed."), backoff_s=0.0)
    second = claim(db, "b")
    assert second is not None
    log(db, second, [3] if crime == "gap" else [2, 3], [0.0] * 3 if crime == "wrong number" else curve)
    if crime == "gap":
        log(db, second, [1], curve)
    witness.look()
    if crime != "unfinished":
        finish(db, second, Succeeded(1.0))
    if crime == "lost number":
        with db.write() as conn:
            conn.execute(metric_values.delete().where(metric_values.c.value == curve[0]))

    found = complaints(witness, {run_id: {METRIC: curve}})
    db.close()

    assert (found == []) is (complaint is None)
    assert complaint is None or any(complaint in sentence for sentence in found)


def test_results_replace_those_before(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(f"# Title\n\n{begin_mark('make it')}\nold\n{END}\n\nThe end.\n")
    finding = Finding("A long queue", [("claims per second", "400")], [])

    write_results(page, "make it", [as_markdown(finding)])
    write_results(page, "make it", [as_markdown(finding)])

    text = page.read_text()
    assert text.count("claims per second | 400") == 1
    assert "old" not in text
    assert text.endswith(f"{END}\n\nThe end.\n")
    assert "Nothing was lost" in as_text(finding)

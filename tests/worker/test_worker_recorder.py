"""The recorder keeps numbers and files, and finds locomotion models unharmed."""

from __future__ import annotations

import hashlib
import time
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import pytest
from sqlalchemy import Connection, select

from backend.store import metrics
from backend.store.claims import Claim
from backend.store.database import Database, open_database
from backend.store.errors import StaleFence, StoreUnavailable
from backend.store.files import find_file, list_files, register_file
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import MetricPoint, append_metrics, read_metrics
from backend.store.outcomes import HandedBack, Succeeded
from backend.store.queue import claim, finish
from backend.store.runs import get_run
from backend.store.settings import Settings
from backend.store.tables import runs
from sldr_core.errors import BadFile, DiskTooFull, LocomotionMissing, TrainingDiverged
from sldr_core.records import Step
from worker.locomotion_files import find_locomotion_models
from worker.metric_writer import MetricWriter
from worker.recorder import StoreRecorder, WriteRecording
from worker.recording.curves import read_curves
from worker.sign_of_life import showing_life

STEP = Step(cycle=1, epoch=1, env_steps=200, episodes=4, updates=4, wall_seconds=0.5)
MODEL = b"weights"


def never() -> None:
    """Ask for nothing."""


@pytest.fixture
def locomotion_claim(db: Database) -> Claim:
    """Return a claimed locomotion run whose dependent waits."""
    launch(db, LaunchOrder("FetchPush", "manipulation", "her-sldr", [0], "smoke"))
    claimed = claim(db, "worker-1")
    assert claimed is not None
    return claimed


def record(db: Database, settings: Settings, claimed: Claim, write: WriteRecording | None = None) -> StoreRecorder:
    return StoreRecorder(db, settings, claimed, never, write)


def write_model(path: Path) -> None:
    path.write_bytes(MODEL)


def next_claim(db: Database, claimed: Claim) -> Claim:
    finish(db, claimed, Succeeded(1.0))
    following = claim(db, "worker-1")
    assert following is not None
    return following


def leave_model(db: Database, settings: Settings, claimed: Claim) -> Path:
    path = settings.run_directory(claimed.run_id) / "locomotion.pt"
    path.parent.mkdir(parents=True)
    path.write_bytes(MODEL)
    digest = hashlib.sha256(MODEL).hexdigest()
    register_file(db, claimed, path.name, "locomotion", str(path.relative_to(settings.home)), len(MODEL), digest)
    return path


def test_everything_logged_is_stored_when_the_recorder_closes(
    db: Database, settings: Settings, locomotion_claim: Claim
) -> None:
    with record(db, settings, locomotion_claim) as recorder:
        recorder.log(STEP, {"test/success_rate": 0.75, "progress/seconds_left": 12.0})

    progress = get_run(db, locomotion_claim.run_id).progress
    assert read_metrics(db, locomotion_claim.run_id).values["test/success_rate"] == [0.75]
    assert progress is not None
    assert (progress.fraction, progress.epochs, progress.success_rate, progress.seconds_left) == (0.25, 2, 0.75, 12.0)


def test_the_last_test_is_remembered_between_tests(db: Database, settings: Settings, locomotion_claim: Claim) -> None:
    with record(db, settings, locomotion_claim) as recorder:
        recorder.log(STEP, {"test/success_rate": 0.75})
        recorder.log(STEP, {"speed/env_steps_per_s": 9.0})

    progress = get_run(db, locomotion_claim.run_id).progress
    assert progress is not None
    assert (progress.success_rate, progress.env_steps_per_s) == (0.75, 9.0)


def test_a_number_that_is_not_finite_ends_the_training_by_name(
    db: Database, settings: Settings, locomotion_claim: Claim
) -> None:
    with (
        record(db, settings, locomotion_claim) as recorder,
        pytest.raises(TrainingDiverged, match="actor/loss became inf in cycle 1"),
    ):
        recorder.log(STEP, {"actor/loss": float("inf")})


def test_a_saved_file_is_registered_with_size_and_checksum(
    db: Database, settings: Settings, locomotion_claim: Claim
) -> None:
    with record(db, settings, locomotion_claim) as recorder:
        path = recorder.save_file("policy.pt", "policy", write_model)

    row = find_file(db, locomotion_claim.run_id, "policy.pt")
    assert (row.size, row.sha256, row.kind) == (len(MODEL), hashlib.sha256(MODEL).hexdigest(), "policy")
    assert settings.home / row.path == path
    assert path.read_bytes() == MODEL


def test_a_file_that_could_not_be_written_leaves_the_old_one(
    db: Database, settings: Settings, locomotion_claim: Claim
) -> None:
    def write_half(path: Path) -> None:
        path.write_bytes(b"half")
        raise OSError("no space left")

    with record(db, settings, locomotion_claim) as recorder:
        path = recorder.save_file("policy.pt", "policy", write_model)
        with pytest.raises(OSError, match="no space left"):
            recorder.save_file("policy.pt", "policy", write_half)

    assert path.read_bytes() == MODEL
    assert sorted(entry.name for entry in path.parent.iterdir()) == ["policy.pt"]


def test_a_stale_attempt_cannot_register_files(db: Database, settings: Settings, locomotion_claim: Claim) -> None:
    with record(db, settings, locomotion_claim) as recorder:
        finish(db, locomotion_claim, HandedBack("Its worker was asked to end."))
        with pytest.raises(StaleFence):
            recorder.save_file("policy.pt", "policy", write_model)

    assert list_files(db, locomotion_claim.run_id) == []


def test_what_was_logged_before_a_checkpoint_is_stored_before_it(
    db: Database, settings: Settings, locomotion_claim: Claim
) -> None:
    stored_at_checkpoint: list[list[int]] = []

    def write(path: Path) -> None:
        path.write_bytes(b"state")
        stored_at_checkpoint.append(read_metrics(db, locomotion_claim.run_id).step)

    with record(db, settings, locomotion_claim) as recorder:
        recorder.log(STEP, {"test/success_rate": 0.5})
        recorder.save_file("checkpoint.pt", "checkpoint", write)

    assert stored_at_checkpoint == [[1]]


class FlakyDatabase(Database):
    """A store that cannot be written now and then, or whose answer gets lost."""

    def __init__(self, settings: Settings) -> None:
        self.__dict__.update(open_database(settings).__dict__)
        self.outages = 0
        self.lost_answers = 0

    @contextmanager
    def write(self) -> Generator[Connection]:
        if self.outages > 0:
            self.outages -= 1
            raise StoreUnavailable("The store cannot be used just now: it is being restarted.")
        with super().write() as conn:
            yield conn
        if self.lost_answers > 0:
            self.lost_answers -= 1
            raise StoreUnavailable("The store cannot be used just now: the answer was lost.")


def test_nothing_is_lost_while_the_store_is_away(db: Database, settings: Settings, locomotion_claim: Claim) -> None:
    flaky = FlakyDatabase(settings)
    with record(flaky, settings, locomotion_claim) as recorder:
        flaky.outages = 3
        recorder.log(STEP, {"test/success_rate": 0.5})
        recorder.save_file("policy.pt", "policy", write_model)
        flaky.outages = 3
        recorder.log(replace(STEP, cycle=2), {"test/success_rate": 0.5})
    flaky.close()

    assert flaky.outages == 0
    assert read_metrics(db, locomotion_claim.run_id).step == [1, 2]
    assert [row.name for row in list_files(db, locomotion_claim.run_id)] == ["policy.pt"]


def test_a_batch_whose_answer_was_lost_is_stored_once(
    db: Database, settings: Settings, locomotion_claim: Claim
) -> None:
    flaky = FlakyDatabase(settings)
    with record(flaky, settings, locomotion_claim) as recorder:
        flaky.lost_answers = 2
        recorder.log(STEP, {"test/success_rate": 0.5})
        recorder.save_file("checkpoint.pt", "checkpoint", write_model)
    flaky.close()

    assert flaky.lost_answers == 0
    assert read_metrics(db, locomotion_claim.run_id).values == {"test/success_rate": [0.5]}


def progress_at(db: Database, claimed: Claim) -> datetime:
    with db.read() as conn:
        return conn.execute(select(runs.c.progress_at).where(runs.c.id == claimed.run_id)).scalar_one()


def test_a_training_that_goes_on_without_logging_shows_that_it_does(db: Database, locomotion_claim: Claim) -> None:
    writer = MetricWriter(db, locomotion_claim, interval_s=0.01, stamp_s=0.02)
    before = progress_at(db, locomotion_claim)
    give_up_at = time.monotonic() + 30.0
    while progress_at(db, locomotion_claim) == before and time.monotonic() < give_up_at:
        writer.check()
        time.sleep(0.01)
    writer.close()

    assert progress_at(db, locomotion_claim) > before


def test_an_attempt_that_moves_files_for_long_shows_that_it_goes_on(db: Database, locomotion_claim: Claim) -> None:
    before = progress_at(db, locomotion_claim)
    with showing_life(db, locomotion_claim, every_s=0.01):
        give_up_at = time.monotonic() + 30.0
        while progress_at(db, locomotion_claim) == before and time.monotonic() < give_up_at:
            time.sleep(0.01)
    after = progress_at(db, locomotion_claim)
    time.sleep(0.1)

    assert after > before
    assert progress_at(db, locomotion_claim) == after


def test_an_attempt_that_moves_files_for_ever_does_not(db: Database, locomotion_claim: Claim) -> None:
    before = progress_at(db, locomotion_claim)
    with showing_life(db, locomotion_claim, every_s=0.01, longest_s=0.0):
        time.sleep(0.1)

    assert progress_at(db, locomotion_claim) == before


def test_an_attempt_that_is_over_moves_its_files_in_peace(db: Database, locomotion_claim: Claim) -> None:
    finish(db, locomotion_claim, HandedBack("Its worker was asked to end."))

    with showing_life(db, locomotion_claim, every_s=0.01):
        time.sleep(0.1)


def test_a_training_that_hangs_shows_no_sign_of_going_on(db: Database, locomotion_claim: Claim) -> None:
    writer = MetricWriter(db, locomotion_claim, interval_s=0.01, stamp_s=0.02)
    before = progress_at(db, locomotion_claim)
    time.sleep(0.3)
    after = progress_at(db, locomotion_claim)
    writer.close()

    assert after == before


def test_the_recording_is_written_at_the_end_when_the_store_has_every_point(
    db: Database, settings: Settings, locomotion_claim: Claim
) -> None:
    found: list[tuple[list[Step], dict]] = []

    def write(path: Path) -> None:
        path.touch()
        steps, curves = read_curves(db, locomotion_claim.run_id)
        found.append((steps, dict(curves)))

    with record(db, settings, locomotion_claim, write) as recorder:
        recorder.log(STEP, {"test/success_rate": 0.75})

    assert found == [([STEP], {"test/success_rate": [0.75]})]
    assert find_file(db, locomotion_claim.run_id, "recording-attempt-1.rrd").kind == "recording"


def test_a_training_that_has_logged_nothing_leaves_no_recording(
    db: Database, settings: Settings, locomotion_claim: Claim
) -> None:
    with record(db, settings, locomotion_claim, Path.touch):
        pass

    assert [row.name for row in list_files(db, locomotion_claim.run_id)] == []


def test_curves_of_several_pages_are_put_together(
    db: Database, locomotion_claim: Claim, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(metrics, "READ_LIMIT", 2)
    logged = [{"a/x": 1.0}, {"a/x": 2.0}, {"a/y": 3.0}, {"a/x": 4.0}, {"a/y": 5.0}]
    steps = [replace(STEP, cycle=cycle) for cycle in range(1, 6)]
    append_metrics(db, locomotion_claim, [MetricPoint(*point) for point in zip(steps, logged, strict=True)])

    assert read_curves(db, locomotion_claim.run_id) == (
        steps,
        {"a/x": [1.0, 2.0, None, 4.0, None], "a/y": [None, None, 3.0, None, 5.0]},
    )


@pytest.mark.parametrize(
    ("error", "has_trace"), [(RuntimeError("no recording today"), True), (DiskTooFull("no recording today"), False)]
)
def test_a_training_does_not_fail_with_its_rerun_file(
    db: Database,
    settings: Settings,
    locomotion_claim: Claim,
    caplog: pytest.LogCaptureFixture,
    error: Exception,
    has_trace: bool,
) -> None:
    def write(path: Path) -> None:
        raise error

    with record(db, settings, locomotion_claim, write) as recorder:
        recorder.log(STEP, {"test/success_rate": 0.75})

    assert "no recording today" in caplog.text
    assert ("Traceback" in caplog.text) == has_trace


def test_the_model_of_the_locomotion_run_is_found(db: Database, settings: Settings, locomotion_claim: Claim) -> None:
    path = leave_model(db, settings, locomotion_claim)

    assert find_locomotion_models(db, settings, next_claim(db, locomotion_claim)) == [path]


def test_a_locomotion_run_without_a_model_is_named(db: Database, settings: Settings, locomotion_claim: Claim) -> None:
    dependent = next_claim(db, locomotion_claim)

    with pytest.raises(LocomotionMissing, match=f"{locomotion_claim.run_id} has left no locomotion model"):
        find_locomotion_models(db, settings, dependent)


def test_a_model_that_is_gone_is_named(db: Database, settings: Settings, locomotion_claim: Claim) -> None:
    path = leave_model(db, settings, locomotion_claim)
    dependent = next_claim(db, locomotion_claim)
    path.unlink()

    with pytest.raises(LocomotionMissing, match=f"of run {locomotion_claim.run_id} is not there .{path} is gone"):
        find_locomotion_models(db, settings, dependent)


def test_a_model_that_has_changed_is_refused(db: Database, settings: Settings, locomotion_claim: Claim) -> None:
    path = leave_model(db, settings, locomotion_claim)
    dependent = next_claim(db, locomotion_claim)
    path.write_bytes(b"other weights")

    with pytest.raises(BadFile, match="is not the file that run"):
        find_locomotion_models(db, settings, dependent)

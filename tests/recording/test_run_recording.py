"""The Rerun file of a run, made from the store: curves, episodes in 3D and the log, laid out."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import psutil
import pytest
from rerun.experimental import RrdReader

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.files import LOG_FILE, FileRow, register_file
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import MetricPoint, append_metrics
from backend.store.queue import claim
from backend.store.settings import Settings
from backend.store.storage import checksum
from sldr_core.config import config_hash, config_to_dict
from sldr_core.envs import make_envs
from sldr_core.episodes import KIND, Origin, RecordedEpisode, RecordedTest, episodes_file, write_episodes
from sldr_core.presets import make_config
from sldr_core.records import Step
from worker.cli.commands.export import main
from worker.recording.blueprint import chart_groups
from worker.recording.log_lines import place_lines
from worker.recording.run_recording import choose_tests, record_run
from worker.recording.scenes import PULL, load_scene, make_scene

STEPS = 3


def step(epoch: int) -> Step:
    return Step(cycle=epoch, epoch=epoch, env_steps=100 * epoch, episodes=2, updates=4, wall_seconds=0.5)


def sldr_episode(task: str) -> tuple[Origin, RecordedEpisode]:
    """Simulate a short manipulation episode of a task under random actions."""
    config = make_config(task, "manipulation", "her-sldr", 0, "smoke")
    envs = make_envs(task, seed=0)
    rng = np.random.default_rng(0)
    goal, qpos = envs.reset().goal[0], [envs.qpos[0].copy()]
    for _ in range(STEPS):
        envs.step(rng.uniform(-1.0, 1.0, (1, envs.action_size)))
        qpos.append(envs.qpos[0].copy())
    parts = tuple(part.name for part in config.task_spec.parts)
    actions = rng.uniform(-1.0, 1.0, (STEPS, len(parts), config.task_spec.object_action_size)).astype(np.float32)
    floats = np.zeros((STEPS, 1 + len(parts)), dtype=np.float32)
    episode = RecordedEpisode(
        index=0,
        tag="other",
        resimulates=True,
        start_state=np.zeros(9),
        rng_state=rng.bit_generator.state,
        qpos=np.stack(qpos),
        qvel=np.zeros((STEPS + 1, 6)),
        obs=np.zeros((STEPS + 1, 2), dtype=np.float32),
        goal=goal,
        achieved=np.zeros((STEPS + 1, len(goal)), dtype=np.float32),
        action=np.zeros((STEPS, envs.action_size), dtype=np.float32),
        reward=floats,
        value=floats,
        wanted=actions,
        induced=-actions,
        contact=np.zeros((STEPS + 1, 1), dtype=bool),
        distance=np.zeros(STEPS + 1),
        angle=np.full(STEPS + 1, np.nan),
        success=np.zeros(STEPS + 1, dtype=bool),
    )
    streams = ("task", *(f"sldr/{part}" for part in parts))
    return Origin(config_to_dict(config), config_hash(config), 2, 200, streams, parts, ("object0",)), episode


@pytest.fixture
def held(db: Database, settings: Settings) -> Claim:
    """Return a claimed run with two epochs of metrics, an episode and a log."""
    launch(db, LaunchOrder("FetchPush", "manipulation", "her", (0,), "smoke"))
    held = claim(db, "here")
    assert held is not None
    append_metrics(db, held, [MetricPoint(step(epoch), {"test/success_rate": 0.5}) for epoch in (1, 2)])
    path = settings.run_directory(held.run_id) / episodes_file(2)
    path.parent.mkdir(parents=True)
    origin, episode = sldr_episode("FetchPush")
    write_episodes(path, RecordedTest(origin, (episode,)))
    place = str(path.relative_to(settings.home))
    register_file(db, held, path.name, KIND, place, path.stat().st_size, checksum(path))
    (path.parent / LOG_FILE).write_text("It begins.\n12:00 epoch 1: test success 50.0 %\n")
    return held


def test_the_command_writes_curves_episodes_and_log(
    settings: Settings, held: Claim, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    for name, value in settings.as_environment().items():
        monkeypatch.setenv(name, value)
    out = tmp_path / "run.rrd"

    assert main(["rerun", held.run_id, str(out)]) == 0

    assert f"rerun {out}" in capsys.readouterr().out
    found = {chunk.entity_path for chunk in RrdReader(out).stream()}
    episode = "/scenes/epoch-0002/0"
    wanted = {"/test/success_rate", "/log", f"{episode}/body/object0", f"{episode}/goal", f"{episode}/path/object0"}
    assert wanted | {f"{episode}/robot", f"{episode}/wanted/object0", f"{episode}/series/reward/task"} <= found


def test_a_file_that_is_renewed_leaves_no_threads(
    db: Database, settings: Settings, held: Claim, tmp_path: Path
) -> None:
    process = psutil.Process()
    record_run(db, settings, held.run_id, tmp_path / "run.rrd")
    after_one = process.num_threads()

    for _ in range(4):
        record_run(db, settings, held.run_id, tmp_path / "run.rrd")

    assert process.num_threads() == after_one


@pytest.mark.parametrize(
    ("task", "goals", "arrows"), [("FetchPush", 1, 2), ("FetchStack2", 2, 4), ("FetchTuple3", 3, 4)]
)
def test_a_scene_has_bodies_goals_and_what_each_part_wanted(task: str, goals: int, arrows: int) -> None:
    origin, episode = sldr_episode(task)
    scene = make_scene(load_scene(origin), origin, episode)
    table = next(body for body in scene.bodies if body.name == "table0")
    moving = next(body for body in scene.bodies if body.name == "object0")
    assert (len(table.position), len(moving.position)) == (1, STEPS + 1)
    np.testing.assert_array_equal(scene.paths["object0"], moving.position)
    # The first free joint of the object holds its position.
    envs = make_envs(task)
    start = int(envs.model.joint("object0:joint").qposadr[0])
    np.testing.assert_allclose(moving.position, episode.qpos[:, start : start + 3], atol=1e-12)
    assert scene.goals.shape == (goals, 3)
    assert len(scene.arrows) == arrows
    np.testing.assert_allclose(scene.arrows[0].vector, PULL * episode.wanted[:, 0, :3], rtol=1e-6)
    assert scene.bones.shape[1] > 5


def test_a_hand_s_target_is_a_body_of_its_scene() -> None:
    origin, episode = sldr_episode("HandBlockFull")
    scene = make_scene(load_scene(origin), origin, episode)
    assert {"object", "target"} <= {body.name for body in scene.bodies}
    assert len(scene.goals) == 0
    assert any(form.solid == "capsule" for body in scene.bodies for form in body.forms)


def test_lines_stand_where_the_last_test_before_them_was() -> None:
    lines = ["It begins.", "12:00 epoch 1: test success 10.0 %", "", "More.", "12:01 epoch 2: test success 20.0 %"]
    placed = place_lines(lines, [step(1), replace(step(1), env_steps=150), step(2)])
    assert [(line.env_steps, line.text) for line in placed] == [
        (0, "It begins."),
        (150, "12:00 epoch 1: test success 10.0 %"),
        (150, "More."),
        (200, "12:01 epoch 2: test success 20.0 %"),
    ]


def test_all_that_is_about_a_stream_is_in_one_chart() -> None:
    names = [
        "critic/task/loss",
        "stream/task/mean",
        "stream/sldr/object/mean",
        "critic/weight_norm",
        "test/success_rate",
    ]
    assert chart_groups(names) == {
        "test": ["test/success_rate"],
        "critic": ["critic/weight_norm"],
        "stream sldr/object": ["stream/sldr/object/mean"],
        "stream task": ["critic/task/loss", "stream/task/mean"],
    }


def test_the_newest_test_is_shown_with_two_spread_over_those_before() -> None:
    rows = [FileRow("run", episodes_file(epoch), KIND, "", 1, "", 1, datetime.now(UTC)) for epoch in (3, 1, 2, 4, 5)]
    assert [(row.name, most) for row, most in choose_tests(rows)] == [
        (episodes_file(5), 2),
        (episodes_file(1), 1),
        (episodes_file(3), 1),
    ]
    assert choose_tests([]) == []

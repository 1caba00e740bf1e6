"""What went wrong in an episode, by hand-made curves; and which tests' episodes stay."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest

from sldr_core.config import TASKS
from sldr_core.envs import TouchSense, make_envs
from sldr_core.envs.rewards import goal_distance, goal_offsets, is_success
from sldr_core.envs.rotations import angle_between, angle_between_axes
from sldr_core.episodes import Tag, episodes_file, kept_epochs, remove_episodes, tag_episodes, tag_shares
from sldr_core.episodes.tags import TAGS

MOMENTS = 21


def still() -> np.ndarray:
    """Return the positions of one object that lies on a table, `[T+1, 1, 3]`."""
    return np.tile([1.3, 0.7, 0.42], (MOMENTS, 1, 1))


def moved(*heights: tuple[int, float]) -> np.ndarray:
    """Return the positions of an object that is pushed by 10 cm; from each moment on it is at this height."""
    position = still()
    position[3:, 0, 0] += 0.1
    for moment, height in heights:
        position[moment:, 0, 2] = height
    return position


def gap(*values: tuple[int, float]) -> np.ndarray:
    """Return a gap of 4 thresholds that from each moment on is another one."""
    curve = np.full(MOMENTS, 4.0)
    for moment, value in values:
        curve[moment:] = value
    return curve


CASES: list[tuple[str, Tag, np.ndarray, np.ndarray, bool, bool]] = [
    ("nobody comes near", "never_touched", gap(), still(), False, False),
    ("it is struck between two moments", "other", gap(), moved(), False, False),
    ("it is touched and does not move", "other", gap(), still(), True, True),
    ("it is at its goal at the end", "success", gap((8, 0.5)), moved(), True, True),
    ("it lies at its goal from the start", "success", gap((0, 0.5)), still(), False, False),
    ("lifted and lost", "dropped", gap(), moved((5, 0.5), (9, 0.42)), True, False),
    ("pushed off the table", "dropped", gap(), moved((9, 0.2)), True, False),
    ("lowered in the gripper", "other", gap(), moved((5, 0.5), (9, 0.42)), True, True),
    ("lifted a little and lost", "other", gap(), moved((5, 0.449), (9, 0.42)), True, False),
    ("lost at its goal", "dropped", gap((5, 0.5), (9, 4.0)), moved((5, 0.5), (9, 0.42)), True, False),
    ("lost on its goal", "success", gap((9, 0.5)), moved((5, 0.5), (9, 0.42)), True, False),
    ("through the goal", "overshot", gap((5, 0.5), (8, 4.0)), moved(), True, True),
    ("nearer and nearer", "too_slow", np.linspace(4.0, 2.0, MOMENTS), moved(), True, True),
    ("nearer, but long ago", "other", gap((5, 2.0)), moved(), True, True),
    ("away", "other", np.linspace(2.0, 4.0, MOMENTS), moved(), True, True),
    ("nearer by less than a tenth", "other", gap((15, 3.7)), moved(), True, True),
]


@pytest.mark.parametrize(
    ("tag", "curve", "position", "touched", "held"), [case[1:] for case in CASES], ids=[case[0] for case in CASES]
)
def test_an_episode_has_the_tag_of_what_happened(
    tag: Tag, curve: np.ndarray, position: np.ndarray, touched: bool, held: bool
) -> None:
    tags = tag_episodes((curve < 1.0)[None], curve[None], position[None], np.array([touched]), np.array([[held]]))

    assert tags == [tag]


def test_each_episode_is_judged_alone() -> None:
    curves, positions = np.stack([case[2] for case in CASES]), np.stack([case[3] for case in CASES])
    touched, held = np.array([case[4] for case in CASES]), np.array([[case[5]] for case in CASES])

    tags = tag_episodes(curves < 1.0, curves, positions, touched, held)

    assert tags == [case[1] for case in CASES]
    assert tag_shares(tags) == {tag: tags.count(tag) / len(CASES) for tag in TAGS}
    assert sum(tag_shares(tags).values()) == pytest.approx(1.0)


def test_one_of_several_objects_is_enough_to_be_dropped() -> None:
    position = np.concatenate([moved(), moved((5, 0.5), (9, 0.42))], axis=1)[None]
    curve = gap()[None]

    for held, tag in (([True, False], "dropped"), ([False, True], "other")):
        assert tag_episodes(curve < 1.0, curve, position, np.array([True]), np.array([held])) == [tag]


def test_an_object_that_moves_itself_is_neither_dropped_nor_untouched() -> None:
    positions = np.stack([still(), moved((5, 0.5), (9, 0.42))])
    curves = np.stack([gap(), gap()])

    assert tag_episodes(curves < 1.0, curves, positions, None, None) == ["other", "other"]


def test_short_episodes_are_compared_with_their_start() -> None:
    curve = np.array([[4.0, 3.9, 2.0]])

    assert tag_episodes(curve < 1.0, curve, moved()[None, 2:5], None, None) == ["too_slow"]


@pytest.mark.parametrize("task", ["FetchPush", "FetchStack2", "FetchTuple3", "HandBlockRotate"])
def test_touches_are_those_that_the_simulator_finds(task: str) -> None:
    envs = make_envs(task, num_envs=3, seed=1)
    rng = np.random.default_rng(0)
    sense, model, data = TouchSense(envs.model), envs.model, mujoco.MjData(envs.model)
    for _ in range(8):
        envs.step(rng.uniform(-1, 1, (3, envs.action_size)))
    # One of the objects is put into the gripper.
    if envs.spec.family != "hand":
        joint = int(model.joint("object0:joint").qposadr[0])
        envs.qpos[0, joint : joint + 3] = envs.simulation.site("robot0:grip").pos[0] + (0.0, 0.03, 0.0)

    found = sense.touches(envs.qpos)

    assert found.any()
    assert sense.objects == (("object",) if envs.spec.family == "hand" else sense.objects)
    assert len(sense.objects) == envs.object_positions(envs.observe().achieved).shape[1]
    for row, qpos in zip(found, envs.qpos, strict=True):
        data.qpos[:] = qpos
        mujoco.mj_forward(model, data)
        met = [{model.body(model.geom_bodyid[geom]).name for geom in contact.geom} for contact in data.contact]
        for touched, name in zip(row, sense.objects, strict=True):
            assert touched == any(name in pair and any(body.startswith("robot0:") for body in pair) for pair in met)


def test_nothing_is_touched_where_there_is_no_robot() -> None:
    envs = make_envs("FetchPush", "locomotion", num_envs=2)
    sense = TouchSense(envs.model)

    assert not sense.has_robot
    assert not sense.touches(envs.qpos).any()


@pytest.mark.parametrize("task", TASKS)
def test_a_goal_is_reached_where_the_gap_is_below_one(task: str) -> None:
    spec, rng = TASKS[task], np.random.default_rng(0)

    goal = rng.normal(size=(200, spec.goal_size))
    achieved = goal + rng.normal(scale=0.03, size=goal.shape)

    offsets = goal_offsets(spec.goal, achieved, goal)

    np.testing.assert_array_equal(offsets.gap < 1.0, is_success(spec.goal, achieved, goal))
    if spec.family == "hand":
        angle = angle_between_axes if spec.goal.ignore_z else angle_between  # pyright: ignore
        np.testing.assert_allclose(offsets.distance, np.linalg.norm(achieved[:, :3] - goal[:, :3], axis=1))
        np.testing.assert_allclose(offsets.angle, angle(achieved[:, 3:], goal[:, 3:]))
    else:
        np.testing.assert_array_equal(offsets.distance, goal_distance(spec.goal, achieved, goal))  # pyright: ignore
        assert np.isnan(offsets.angle).all()


def test_all_tests_are_kept_while_they_are_few_then_every_second_and_fourth() -> None:
    assert kept_epochs(1, 1) == {1}
    assert kept_epochs(64, 20) == set(range(1, 65))
    assert kept_epochs(65, 20) == {*range(1, 66, 2), 20}
    assert kept_epochs(130, 77) == {*range(1, 131, 4), 77, 130}


def test_what_was_dropped_is_never_missed_later() -> None:
    there: set[int] = set()
    for newest in range(1, 1001):
        best = newest - newest % 7 or 1
        there = (there | {newest}) & kept_epochs(newest, best)
        assert there == kept_epochs(newest, best) & there
        assert kept_epochs(newest, best) - there <= {best}, "a best test is the newest one when it becomes the best"
        assert len(there) <= 66


def test_files_of_dropped_epochs_are_removed_and_others_left(tmp_path: Path) -> None:
    for epoch in (1, 2, 3, 4, 5):
        (tmp_path / episodes_file(epoch)).touch()
    (tmp_path / "policy-best.pt").touch()
    (tmp_path / ".episodes-epoch-0002.npz.7.tmp").touch()

    remove_episodes(tmp_path, newest=4, kept_epochs={1, 3, 4})

    # The fifth was left by an attempt that had come further; it will be written again.
    left = sorted(path.name for path in tmp_path.iterdir())
    assert left == [
        ".episodes-epoch-0002.npz.7.tmp",
        *(episodes_file(epoch) for epoch in (1, 3, 4, 5)),
        "policy-best.pt",
    ]

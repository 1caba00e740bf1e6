"""Maps against plain loops, and every draw of every task inside the spaces that are drawn for it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mujoco_turns import inverse, product, vector_of

from sldr_core.demonstrations import Axis, Space, cover, spaces_of
from sldr_core.demonstrations.outcomes import NEVER
from sldr_core.demonstrations.placing import joint_pose
from sldr_core.envs import Start

LOCOMOTION_TASKS = ["FetchPush", "FetchSlide", "FetchPickAndPlace", "FetchTuple3", "FetchTuple5", "HandBlockRotate"]
DRAWS = 12


def test_a_map_counts_as_a_plain_loop_does():
    rng = np.random.default_rng(0)
    places = np.column_stack([rng.uniform(0, 3, 80), rng.uniform(0, 2, 80), rng.integers(0, 2, 80)]).astype(np.float64)
    arrival = rng.integers(NEVER, 5, 80)
    x, y = Axis("x", "cm", (0.0, 1.0, 2.0, 3.0)), Axis("y", "cm", (0.0, 1.0, 2.0))
    space = Space("test", "", x, y, Axis("layer", "", (-0.5, 0.5, 1.5)), lambda start, numbers: places)
    empty = np.empty((80, 0))
    covered = cover(space, Start(empty, empty, empty), np.arange(80), arrival)
    for layer in range(2):
        for row in range(2):
            for column in range(3):
                inside = [
                    int(step)
                    for place, step in zip(places, arrival, strict=True)
                    if (math.floor(place[0]), math.floor(place[1]), place[2]) == (column, row, layer)
                ]
                arrived = [0.04 * step for step in inside if step != NEVER]
                assert covered.episodes[layer, row, column] == len(inside)
                assert covered.successes[layer, row, column] == len(arrived)
                median = covered.median_s[layer, row, column]
                assert np.isnan(median) if not arrived else median == pytest.approx(np.median(arrived))


def test_what_lies_beyond_the_edges_is_counted_at_the_border():
    axis = Axis("x", "cm", (0.0, 1.0, 2.0))
    assert axis.place(np.array([-5.0, 0.0, 0.99, 1.0, 2.0, 7.0])).tolist() == [0, 0, 0, 1, 1, 1]


@pytest.mark.parametrize("task", [*LOCOMOTION_TASKS, "FetchStack2", "HandBlockTranslate", "HandPenRotateXYZ"])
def test_every_draw_lies_within_the_spaces_of_its_task(inspect, task):
    inspected = inspect("FetchPickAndPlace" if task == "FetchStack2" else task)
    envs = inspected.make_envs(DRAWS)
    source = inspected.starts(task, envs)
    drawn, numbers = source.draw(0, range(DRAWS)).start, np.arange(DRAWS)
    spaces = spaces_of(source.task, envs.model)
    assert spaces
    for space in spaces:
        places = space.coordinates(drawn, numbers)
        for axis, values in zip((space.x, space.y, space.layer), places.T, strict=True):
            assert axis.edges[0] - 1e-9 <= values.min() <= values.max() <= axis.edges[-1] + 1e-9, (
                space.name,
                axis.name,
            )


def test_a_turn_is_told_by_its_angle_and_nearest_axis(inspect):
    inspected = inspect("HandBlockRotate")
    envs = inspected.make_envs(DRAWS)
    drawn = inspected.starts("HandBlockRotate", envs).draw(1, range(DRAWS)).start
    (space,) = spaces_of(inspected.task, envs.model)
    lies = drawn.qpos[:, joint_pose(envs.model, 0)][:, 3:]
    turns = [vector_of(product(goal, inverse(start))) for goal, start in zip(drawn.goal[:, 3:], lies, strict=True)]
    directions = ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))
    for turn, place in zip(turns, space.coordinates(drawn, np.arange(DRAWS)), strict=True):
        assert place[0] == pytest.approx(math.degrees(np.linalg.norm(turn)), abs=1e-4)
        assert place[1] == int(np.argmax([np.dot(turn, direction) for direction in directions]))


def test_a_chain_s_goal_is_told_by_its_shape(inspect):
    inspected = inspect("FetchTuple5")
    envs = inspected.make_envs(1)
    placing = inspected.placing(envs)
    start = inspected.starts("FetchTuple5", envs).draw(0, [0]).start
    goals = spaces_of(inspected.task, envs.model)[0]
    assert goals.layer.names == ("L", "L, half a turn", "T", "T, half a turn")
    shapes = [goals.coordinates(placing.put_shape(start, shape), np.zeros(1, int))[0, 2] for shape in range(4)]
    assert shapes == [0, 1, 2, 3]

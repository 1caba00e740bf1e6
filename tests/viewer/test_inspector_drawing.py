"""Paths, sheets and colours of the inspector as pure functions."""

from __future__ import annotations

import numpy as np
import pytest

from sldr_core.config import find_task
from sldr_core.demonstrations import Landscape, Slice
from worker.viewer.inspector.colours import SCALE, colours_of, shares_of
from worker.viewer.inspector.paths import MARK_RADIUS, chosen_paths, path_points, segments
from worker.viewer.inspector.surfaces import enlarge, even_directions, picture_of, sheet_of


def test_a_path_of_an_object_that_turned_as_it_should_ends_on_top():
    goal = np.random.default_rng(0).normal(size=(3, 7))
    goal[:, 3:] /= np.linalg.norm(goal[:, 3:], axis=1, keepdims=True)
    achieved = np.random.default_rng(1).normal(size=(3, 5, 7))
    achieved[:, :, 3:] /= np.linalg.norm(achieved[:, :, 3:], axis=2, keepdims=True)
    achieved[:, -1, 3:] = -goal[:, 3:]
    (path,) = path_points(find_task("HandBlockRotate"), achieved, goal)
    assert path[:, -1] - achieved[:, -1, :3] == pytest.approx(np.tile([0.0, 0.0, MARK_RADIUS], (3, 1)))
    assert np.linalg.norm(path - achieved[:, :, :3], axis=2) == pytest.approx(np.full((3, 5), MARK_RADIUS))


def test_the_paths_of_a_chain_are_those_of_its_ends():
    achieved = np.arange(2 * 4 * 15, dtype=float).reshape(2, 4, 15)
    first, last = path_points(find_task("FetchTuple5"), achieved, achieved[:, 0])
    assert np.array_equal(first, achieved[..., :3])
    assert np.array_equal(last, achieved[..., 12:])


def test_failures_are_drawn_first_where_not_all_can_be():
    reached = np.array([[True], [False], [True], [False]])
    assert chosen_paths(reached, most=3).tolist() == [0, 1, 3]


def test_a_path_is_made_of_pieces_between_neighbours():
    pieces = segments(np.arange(12.0).reshape(1, 4, 3))
    assert pieces[:, 0].tolist() == [[0, 1, 2], [3, 4, 5], [6, 7, 8]]
    assert pieces[:, 1].tolist() == [[3, 4, 5], [6, 7, 8], [9, 10, 11]]


def test_colours_reach_from_one_end_of_the_scale_to_the_other():
    assert colours_of(shares_of(np.array([-2.0, 3.0]))).tolist() == [SCALE[0].tolist(), SCALE[-1].tolist()]
    assert colours_of(shares_of(np.full(2, 7.0))).tolist() == [SCALE[0].tolist()] * 2


def test_a_finer_grid_keeps_the_points_and_goes_straight_between_them():
    fine = enlarge(np.array([[0.0, 2.0], [4.0, 6.0]]), 2)
    assert fine.tolist() == [[0, 1, 2], [2, 3, 4], [4, 5, 6]]


def test_a_picture_has_its_first_row_on_top_where_viser_has_the_least_y():
    picture = picture_of(np.array([[0.0, 0.0], [0.0, 1.0]]))
    assert picture[-1, -1, :3].tolist() == SCALE[-1].tolist()
    assert picture[0, 0, :3].tolist() == SCALE[0].tolist()


@pytest.mark.parametrize(("axes", "normal"), [((0, 1), (0, 0, 1)), ((0, 2), (0, -1, 0)), ((1, 2), (1, 0, 0))])
def test_a_sheet_lies_in_its_plane(axes, normal):
    plane = Slice("position", axes, (1.0, 2.0), (0.4, 0.8))
    seen = Landscape(plane, np.zeros((25, 25), dtype=np.float32), (1.5, 0.6), 0.0)
    sheet = sheet_of(seen, np.array([1.2, 0.7, 0.5]), reach=0.1)
    w, x, y, z = sheet.quaternion()
    out = (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))
    assert out == pytest.approx(normal, abs=1e-9)
    assert [sheet.centre[axis] for axis in axes] == pytest.approx([1.5, 0.6])
    assert sheet.size == pytest.approx((1.0, 0.4))


def test_axes_of_a_shell_are_spread_evenly():
    directions = even_directions(240)
    assert np.linalg.norm(directions, axis=1) == pytest.approx(np.ones(240))
    assert directions.mean(axis=0) == pytest.approx(np.zeros(3), abs=0.01)

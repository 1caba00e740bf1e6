"""Rotation vectors against MuJoCo's functions."""

from __future__ import annotations

import numpy as np
import pytest
from mujoco_turns import inverse, product, quaternion_of, vector_of

from sldr_core.envs.rotations import quaternion_from_vector, rotation_vector, turn_between


@pytest.fixture
def quaternions() -> np.ndarray:
    drawn = np.random.default_rng(0).normal(size=(50, 4))
    return drawn / np.linalg.norm(drawn, axis=1, keepdims=True)


def test_vectors_and_quaternions_are_those_of_mujoco(quaternions):
    vectors = np.array([vector_of(quaternion) for quaternion in quaternions])
    assert rotation_vector(quaternions) == pytest.approx(vectors, abs=1e-9)
    assert rotation_vector(-quaternions) == pytest.approx(vectors, abs=1e-9)
    again = np.array([quaternion_of(vector) for vector in vectors])
    assert quaternion_from_vector(vectors) == pytest.approx(again, abs=1e-9)


def test_no_turn_is_no_vector():
    assert quaternion_from_vector(np.zeros(3)).tolist() == [1.0, 0.0, 0.0, 0.0]
    assert rotation_vector(np.array([1.0, 0.0, 0.0, 0.0])).tolist() == [0.0, 0.0, 0.0]
    tiny = np.array([1e-9, 0.0, 0.0])
    assert rotation_vector(quaternion_from_vector(tiny)) == pytest.approx(tiny, rel=1e-6)


def test_the_turn_between_two_brings_one_to_the_other(quaternions):
    a, b = quaternions[:25], quaternions[25:]
    turns = [vector_of(product(later, inverse(earlier))) for earlier, later in zip(a, b, strict=True)]
    assert rotation_vector(turn_between(a, b)) == pytest.approx(np.array(turns), abs=1e-9)

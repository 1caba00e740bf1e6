"""What cannot be built is refused by its name, before anything is built."""

from __future__ import annotations

from typing import Any

import pytest

from sldr_core.envs import make_envs
from sldr_core.errors import InvalidConfig, UnknownName


@pytest.mark.parametrize(
    ("order", "told"),
    [
        ({"task": "FetchPsh"}, r"No task is called 'FetchPsh'\. Did you mean 'FetchPush'"),
        ({"phase": "locomotoin"}, r"No phase is called 'locomotoin'\. Did you mean 'locomotion'"),
        ({"robot": "abscent"}, r"No robot is called 'abscent'\. Did you mean 'absent'"),
        ({"variant": "orignal"}, r"No variant is called 'orignal'\. Did you mean 'original'"),
        ({"reward": "dens"}, r"No reward is called 'dens'\. Did you mean 'dense'"),
    ],
)
def test_names_that_do_not_exist(order: dict[str, Any], told: str) -> None:
    with pytest.raises(UnknownName, match=told):
        make_envs(**{"task": "FetchPush", **order})


@pytest.mark.parametrize(
    ("order", "told"),
    [
        ({"task": "HandEggTranslate"}, "HandEggTranslate exists for locomotion only"),
        ({"task": "FetchStack2", "phase": "locomotion"}, "the objects of FetchStack2 learn in"),
        ({"task": "HandEggRotate", "phase": "locomotion", "robot": "absent"}, "the object lies in the hand"),
        ({"task": "FetchPush", "num_envs": 0}, "num_envs: has to be 1 or more"),
        ({"task": "FetchPush", "threads": 0}, "threads: has to be 1 or more"),
    ],
)
def test_orders_that_cannot_be_met(order: dict[str, Any], told: str) -> None:
    with pytest.raises(InvalidConfig, match=told):
        make_envs(**order)

"""The inspector without a page: what its commands change, and what it tells."""

from __future__ import annotations

import json
from collections.abc import Iterator

import numpy as np
import pytest
import torch
import viser

from sldr_core.demonstrations import BLOCK, Inspected
from sldr_core.nets.locomotion_model import LocomotionModel, LocomotionNets, Measured
from sldr_core.presets import make_config
from worker.viewer.commands import BadCommand, read_command
from worker.viewer.control import to_json
from worker.viewer.inspector.inspection import Inspection
from worker.viewer.inspector.show import InspectorShow
from worker.viewer.page import open_page

Q_POINTS = 25


@pytest.fixture(scope="module")
def server() -> Iterator[viser.ViserServer]:
    server = open_page()
    yield server
    server.stop()


def inspect(task: str) -> Inspection:
    config = make_config(task, "locomotion", "her", 0, "smoke")
    nets = LocomotionNets(config, torch.Generator().manual_seed(1)).requires_grad_(False).eval()
    return Inspection(Inspected(LocomotionModel(nets, config, Measured(0.5, 8))))


@pytest.fixture(scope="module", autouse=True)
def one_thread() -> Iterator[None]:
    """Keep the networks, which are tiny here, off the other cores."""
    before = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(before)


@pytest.fixture(scope="module")
def collected() -> Iterator[InspectorShow]:
    """Return a view, on a page of its own, with a fan of one block."""
    server = open_page()
    show = InspectorShow(server, inspect("FetchPickAndPlace"))
    show.transport.is_playing = False
    ask(show, "fan", count=BLOCK, seed=4)
    while show.state()["fan"]["collecting"]:
        show.advance(0.0)
    yield show
    server.stop()


@pytest.fixture(scope="module")
def inspection() -> Inspection:
    return inspect("FetchPickAndPlace")


@pytest.fixture
def show(server: viser.ViserServer, inspection: Inspection) -> InspectorShow:
    inspection.use_starts("FetchPickAndPlace")
    show = InspectorShow(server, inspection)
    show.transport.is_playing = False
    return show


def ask(show: InspectorShow, do: str, **values):
    """Send a command as a page does, and return the answer as a page gets it."""
    answer = show.obey(read_command(json.dumps({"do": do, **values})))
    show.advance(0.0)
    return json.loads(to_json({"answer": answer}))["answer"]


def test_a_fan_is_summed_up_mapped_and_listed(collected):
    show = collected
    fan = show.state()["fan"]
    failures = ask(show, "failures")
    assert fan["done"] == BLOCK
    assert failures["total"] == BLOCK - fan["successes"]
    for space in ask(show, "about")["spaces"]:
        covered = ask(show, "map", space=space["name"])
        assert np.sum(covered["episodes"]) == BLOCK
        assert np.sum(covered["successes"]) == fan["successes"]


def test_a_failure_is_replayed_to_the_last_bit(collected):
    show = collected
    failure = ask(show, "failures")["failures"][0]
    ask(show, "open", seed=4, number=failure["number"])
    state = show.state()
    assert (state["origin"], state["exact"], state["reached"]) == ("replayed", True, False)
    assert show.report()["goal"].tolist() == failure["goal"]


def test_the_moment_that_is_reported_is_that_of_the_demonstration(show, inspection):
    ask(show, "open", seed=0, number=3)
    show.transport.seek(7)
    show.advance(0.0)
    assert np.array_equal(show.report()["qpos"], inspection.demonstration.qpos[0, 7])


def test_start_and_goal_are_put_elsewhere(show):
    ask(show, "place", what="goal", position=[1.3, 0.7, 0.6], quaternion=[1, 0, 0, 0])
    ask(show, "place", what="start", position=[1.25, 0.75, 0.0], quaternion=[1, 0, 0, 0])
    assert show.state()["origin"] == "placed"
    assert show.report()["goal"].tolist() == [1.3, 0.7, 0.6]
    assert show.report()["qpos"][:2].tolist() == [1.25, 0.75]


def test_a_stack_s_objects_act_side_by_side(show):
    ask(show, "starts", task="FetchStack2")
    assert ask(show, "about")["objects"] == ["block 1", "block 2"]
    assert len(show.report()["qpos"]) == 14
    columns = ask(show, "timeline")["columns"]
    assert {"value/Q of what it does of block 2", "distance/goal of block 1"} <= set(columns)
    with pytest.raises(BadCommand, match="cannot be put by hand"):
        ask(show, "place", what="goal", position=[1.3, 0.7, 0.6], quaternion=[1, 0, 0, 0])


def test_a_slice_follows_the_clock(show):
    for kind in ask(show, "about")["slices"]:
        ask(show, "choose-slice", kind=kind["kind"], plane=0, body=0, part=0)
        first = ask(show, "slice")
        show.transport.seek(9)
        show.advance(0.0)
        second = ask(show, "slice")
        assert np.shape(second["value"]) == (Q_POINTS, Q_POINTS)
        assert second["version"] > first["version"]
        assert second["here"] != first["here"] or kind["kind"] == "goal"
        show.transport.seek(0)


def test_what_is_shown_can_be_hidden(show):
    for look in ("path", "fan", "arrows", "surface", "grips"):
        for wanted in (False, True):
            ask(show, "look", at=look, on=wanted)
            assert show.state()["looks"][look] is wanted


@pytest.mark.parametrize(
    ("do", "values", "wanted"),
    [
        ("fan", {"count": 10**6, "seed": 0}, "from 24 to 1920"),
        ("map", {"space": "turn"}, '"goal" or "start"'),
        ("choose-slice", {"kind": "turn", "plane": 0, "body": 0, "part": 0}, '"position"'),
        ("shape", {"shape": 0}, "Only the goals of chains"),
        ("starts", {"task": "FetchPush"}, "FetchStack2"),
        ("slice", {}, "No slice is shown"),
        (
            "place",
            {"what": "goal", "position": [1, 1, 1], "quaternion": [0, 0, 0, 0]},
            "a quaternion, which is not zero",
        ),
        ("dance", {}, "it has about"),
    ],
)
def test_what_makes_no_sense_is_refused_in_a_sentence(show, do, values, wanted):
    with pytest.raises(BadCommand, match=wanted):
        ask(show, do, **values)


@pytest.mark.parametrize("task", ["FetchTuple3", "HandBlockRotate"])
def test_chains_and_objects_in_the_hand_are_inspected_too(server, task):
    show = InspectorShow(server, inspect(task))
    show.transport.is_playing = False
    about = ask(show, "about")
    for number, kind in enumerate(about["slices"]):
        ask(show, "choose-slice", kind=kind["kind"], plane=0, body=about["bodies"] - 1, part=0)
        assert ask(show, "slice")["version"] == number + 1
    if about["shapes"]:
        goal = show.report()["goal"]
        ask(show, "shape", shape=0)
        ask(show, "shape", shape=1)
        assert not np.array_equal(show.report()["goal"], goal)
    ask(show, "look", at="grips", on=True)
    ask(show, "open", seed=1, number=1)


def test_a_number_of_another_seed_than_the_fan_s_is_drawn_anew(collected):
    ask(collected, "open", seed=5, number=1)
    state = collected.state()
    assert (state["origin"], state["exact"], state["seed"]) == ("drawn", None, 5)

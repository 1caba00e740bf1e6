"""Methods are data: what each is made of, by what two differ, and what the page about them says."""

from __future__ import annotations

import json
from dataclasses import asdict, fields
from itertools import product
from pathlib import Path

import pytest
from small_training import collected_parts, save_untrained_model, tiny_config

from sldr_core.config import METHODS, SWITCHES, TASKS, MethodSpec, find_task, method_switches, stream_names
from sldr_core.errors import UnknownName
from sldr_core.presets import make_config
from sldr_core.training.build import AUXILIARY, SAMPLERS

ROOT = Path(__file__).parents[2]
TIMEOUT_S = 60
WORDS = {"name", "title", "summary", "explanation", "paper"}
"""Fields of a method that decide nothing."""

LONGEST_SUMMARY = 100
"""Letters that a card of the launch form has room for."""


def test_the_seven_methods_are_there_in_their_order() -> None:
    assert list(METHODS) == ["ddpg", "her", "cher", "her-dense", "ddpg-sldr", "her-rnd", "her-sldr"]


def test_no_two_methods_are_made_of_the_same() -> None:
    assert [pair for pair in product(METHODS, METHODS) if pair[0] != pair[1] and not method_switches(*pair)] == []


def test_every_field_is_a_switch_or_words() -> None:
    assert {field.name for field in fields(MethodSpec)} == WORDS | set(SWITCHES)


def test_the_texts_of_methods_are_sentences_that_fit() -> None:
    assert {name: len(spec.summary) for name, spec in METHODS.items() if len(spec.summary) > LONGEST_SUMMARY} == {}
    texts = [text for spec in METHODS.values() for text in (spec.summary, spec.explanation)]
    assert [text for text in texts if not text.endswith(".")] == []
    assert all("§" in spec.paper for spec in METHODS.values())


def test_switches_tell_what_differs() -> None:
    switches = method_switches("ddpg", "her-sldr")

    told = [(switch.name, switch.first, switch.second) for switch in switches]
    assert told == [("relabel_probability", "0", "0.8"), ("auxiliary", "none", "sldr")]
    assert [switch.title for switch in switches] == ["share of goals replaced in hindsight", "further rewards"]
    assert json.loads(json.dumps([asdict(switch) for switch in switches]))[0]["second"] == "0.8"


def test_switches_between_a_method_and_itself_are_none() -> None:
    assert method_switches("cher", "cher") == ()


@pytest.mark.parametrize("pair", [("her", "herr"), ("herr", "her")])
def test_switches_of_an_unknown_method_name_it(pair: tuple[str, str]) -> None:
    with pytest.raises(UnknownName, match="No method is called 'herr'"):
        method_switches(*pair)


def test_switches_turned_round_change_sides() -> None:
    for one, other in product(METHODS, METHODS):
        there = [(switch.name, switch.first, switch.second) for switch in method_switches(one, other)]
        back = [(switch.name, switch.second, switch.first) for switch in method_switches(other, one)]
        assert there == back


def test_every_sampler_and_further_reward_of_a_method_can_be_built() -> None:
    assert {spec.sampler for spec in METHODS.values()} == set(SAMPLERS)
    assert {name for spec in METHODS.values() for name in spec.auxiliary} == set(AUXILIARY)


@pytest.mark.parametrize("method", METHODS)
def test_a_training_has_the_streams_that_its_method_names(method: str, tmp_path: Path) -> None:
    config = tiny_config("manipulation", method)
    parts = collected_parts(config, tmp_path, (save_untrained_model(tmp_path / "model.pt"),))

    assert tuple(stream.name for stream in parts.streams) == stream_names(METHODS[method], config.task_spec)
    assert [stream.weight for stream in parts.streams] == [1.0] * len(parts.streams)


def test_stacks_have_a_critic_more_than_blocks_and_full_tasks_three() -> None:
    counts = {task: len(stream_names(METHODS["her-sldr"], find_task(task))) for task in TASKS}

    assert {task: count for task, count in counts.items() if count != 2} == {
        "FetchStack2": 3,
        "FetchStack3": 4,
        "HandEggFull": 3,
        "HandBlockFull": 3,
        "HandPenFull": 3,
    }


def test_the_dense_reward_is_that_of_its_method_alone(tmp_path: Path) -> None:
    rewards = {}
    for method in ("her", "her-dense"):
        (tmp_path / method).mkdir()
        sample = collected_parts(tiny_config("manipulation", method), tmp_path / method).sampler.sample(200, 0)
        rewards[method] = set(sample.reward.tolist())

    assert rewards["her"] <= {0.0, -1.0}
    assert min(rewards["her-dense"]) < 0.0
    assert -1.0 not in rewards["her-dense"]


def test_cher_learns_from_a_quarter_of_the_usual_batch() -> None:
    config = make_config("FetchPush", "manipulation", "cher", 0, "paper")

    groups = config.loop.batch_size // config.curriculum.group_size
    assert (groups, groups * config.curriculum.candidates, groups * config.curriculum.kept) == (19, 2432, 1216)

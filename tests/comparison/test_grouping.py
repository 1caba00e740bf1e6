"""Which runs belong together, how groups are called, and which run of a repeated seed is shown."""

from __future__ import annotations

from dataclasses import replace

from backend.comparison.groups import group_runs
from backend.comparison.variants import deviations, distinguishing, label
from backend.store.compared_runs import ComparedRun
from backend.store.states import RunState
from sldr_core.config import config_to_dict, flatten
from sldr_core.presets import make_config

RUN = ComparedRun("a", 1, "FetchPush", "manipulation", "her", 0, "quick", 1, "hash", RunState.SUCCEEDED, 5)


def config(overrides: dict | None = None, seed: int = 3, preset: str = "quick") -> dict:
    return config_to_dict(make_config("FetchPush", "manipulation", "her", seed, preset, overrides))


def test_a_run_of_its_preset_deviates_in_nothing_whatever_its_seed():
    assert deviations(config(), "quick") == ()


def test_overrides_are_deviations_and_where_it_was_computed_is_none():
    changed = config({"agent": {"learning_rate": 3e-4}, "compute": {"threads": 2, "device": "cpu"}})
    assert deviations(changed, "quick") == (("agent.learning_rate", "0.0003"),)


def test_names_of_a_later_version_group_by_their_whole_config():
    assert deviations(config() | {"method": "her-2"}, "quick") == ()


def test_what_all_share_tells_nothing_apart():
    shared, own = ("agent.gamma", "0.9"), ("agent.learning_rate", "0.1")
    assert distinguishing([(shared, own), (shared,)]) == {"agent.learning_rate"}
    assert distinguishing([(shared,), (shared,)]) == set()
    assert distinguishing([]) == set()


def test_a_label_names_groups_of_settings_only_where_it_must():
    variant = (("agent.weight", "1"), ("preset", "quick"), ("sldr.weight", "2"))
    assert label(variant, ["agent.weight", "preset"]) == "weight 1, quick"
    assert label(variant, ["agent.weight", "sldr.weight"]) == "agent.weight 1, sldr.weight 2"


def test_flattened_settings_have_dotted_names():
    assert flatten({"a": {"b": {"c": 1}}, "d": [2]}) == {"a.b.c": 1, "d": [2]}


def test_methods_come_in_their_own_order_with_their_own_colours():
    runs = [replace(RUN, id=method, method=method) for method in ("her-sldr", "ddpg", "her")]
    grouping = group_runs(runs, {run.id: () for run in runs})
    assert [(group.key, group.color, group.dash) for group in grouping.groups] == [
        ("ddpg", 6, 6),
        ("her", 1, 1),
        ("her-sldr", 0, 0),
    ]
    assert grouping.groups[2].label == "HER-Sparse+SLDR"


def test_a_method_keeps_its_colour_when_others_are_missing():
    [group] = group_runs([RUN], {"a": ()}).groups
    assert (group.color, group.variant) == (1, "")


def test_variants_share_their_method_s_colour_beside_others_and_differ_in_dashes():
    runs = [RUN, replace(RUN, id="b", seed=0), replace(RUN, id="c", method="her-sldr")]
    groups = group_runs(runs, {"a": (), "b": (("agent.gamma", "0.9"),), "c": ()}).groups
    assert [(group.key, group.label, group.color, group.dash) for group in groups] == [
        ("her", "HER-Sparse", 1, 1),
        ("her|gamma 0.9", "HER-Sparse (gamma 0.9)", 1, 2),
        ("her-sldr", "HER-Sparse+SLDR", 0, 0),
    ]


def test_variants_of_one_method_alone_have_colours_of_their_own():
    runs = [RUN, replace(RUN, id="b", seed=0)]
    groups = group_runs(runs, {"a": (), "b": (("agent.gamma", "0.9"),)}).groups
    assert [(group.key, group.color, group.dash) for group in groups] == [("her", 1, 1), ("her|gamma 0.9", 2, 2)]


def test_presets_are_told_apart():
    runs = [RUN, replace(RUN, id="b", preset="paper")]
    assert [group.variant for group in group_runs(runs, {"a": (), "b": ()}).groups] == ["paper", "quick"]


def test_runs_that_learn_from_different_locomotion_runs_are_told_apart_where_nothing_else_does():
    sldr = replace(RUN, method="her-sldr")
    runs = [
        replace(sldr, id="a"),
        replace(sldr, id="b", seed=1),
        replace(sldr, id="c"),
        replace(sldr, id="d", seed=2),
        replace(sldr, id="e", task="FetchSlide"),
    ]
    models = {"a": "good", "b": "good", "c": "bad", "e": "slides"}
    grouping = group_runs(runs, {run.id: () for run in runs}, models)
    assert {key: [run.id for run in cell] for key, cell in grouping.cells.items()} == {
        ("FetchPush", "her-sldr"): ["d"],
        ("FetchPush", "her-sldr|locomotion bad"): ["c"],
        ("FetchPush", "her-sldr|locomotion good"): ["a", "b"],
        ("FetchSlide", "her-sldr"): ["e"],
    }
    assert grouping.left_out == []


def test_one_locomotion_run_tells_nothing_apart():
    runs = [RUN, replace(RUN, id="b", method="her-sldr"), replace(RUN, id="c", method="her-sldr", seed=1)]
    groups = group_runs(runs, {run.id: () for run in runs}, {"b": "good", "c": "good"}).groups
    assert [group.key for group in groups] == ["her", "her-sldr"]


def test_tasks_come_in_the_paper_s_order_and_seeds_ascend():
    runs = [
        replace(RUN, id="a", task="HandEggFull"),
        replace(RUN, id="b", seed=4),
        replace(RUN, id="c", seed=2),
        replace(RUN, id="d", task="FetchNew"),
    ]
    grouping = group_runs(runs, {run.id: () for run in runs})
    assert grouping.tasks == ["FetchPush", "HandEggFull", "FetchNew"]
    assert [run.id for run in grouping.cells["FetchPush", "her"]] == ["c", "b"]


def test_of_a_repeated_seed_one_that_ended_well_is_shown_and_the_other_named():
    runs = [replace(RUN, id="old"), replace(RUN, id="new", number=2, state=RunState.RUNNING)]
    grouping = group_runs(runs, {"old": (), "new": ()})
    assert [run.id for run in grouping.cells["FetchPush", "her"]] == ["old"]
    assert [(left.run_id, left.reason) for left in grouping.left_out] == [
        ("new", "It repeats seed 0, of which run old is shown.")
    ]


def test_of_equals_the_newest_is_shown_unless_it_has_logged_nothing():
    runs = [
        replace(RUN, id="old"),
        replace(RUN, id="new", number=2),
        replace(RUN, id="bare", number=3, newest_step_id=0),
    ]
    grouping = group_runs(runs, {run.id: () for run in runs})
    assert [run.id for run in grouping.cells["FetchPush", "her"]] == ["new"]

"""What a study can ask for, and what is said of one that cannot work; and what launching it will cost."""

from __future__ import annotations

import pytest
from study_cases import small_spec

from backend.store.run_plans import PlannedRun
from backend.store.speeds import STARTING_S, Speed, Speeds
from backend.store.studies.estimate import estimate
from backend.store.studies.spec import (
    MOST_PLACES,
    PLAIN,
    Cell,
    Place,
    Variant,
    check_name,
    check_spec,
    make_configs,
    spec_from_dict,
    spec_to_dict,
)
from backend.store.studies.templates import FAMILIES, TEMPLATES
from sldr_core.config import METHODS, TASKS, config_hash, settings_hash
from sldr_core.errors import InvalidConfig, UnknownName
from sldr_core.presets import make_config
from sldr_core.presets.budget import control_steps, gradient_updates


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"tasks": ()}, "tasks: none is given; choose at least one"),
        ({"methods": ("her", "her")}, "methods: her is listed more than once"),
        ({"seeds": (3, 3)}, "seeds: 3 is listed more than once"),
        ({"tasks": ("FetchPus",)}, "Did you mean 'FetchPush'?"),
        ({"methods": ("herr",)}, "Did you mean 'her'?"),
        ({"preset": "slow"}, "No preset is called 'slow'"),
        ({"seeds": tuple(range(MOST_PLACES))}, f"these are {2 * MOST_PLACES} runs and a study may have {MOST_PLACES}"),
        ({"overrides": {"seed": 1}}, "seed: is named by the launch itself"),
        ({"variants": (Variant("a"), Variant("a "))}, "variants: a is listed more than once"),
        ({"variants": (Variant(" "),)}, "variants: a name is empty"),
        ({"variants": (Variant("a" * 81),)}, "it may have 80 letters, and this one has 81"),
    ],
)
def test_a_study_that_cannot_work_is_refused_in_a_sentence(changes: dict, sentence: str) -> None:
    with pytest.raises((InvalidConfig, UnknownName)) as caught:
        check_spec(small_spec(**changes))
    assert sentence in str(caught.value)


@pytest.mark.parametrize("name", ["", "  ", "a\0b", "\ud800", "x" * 81, "a\tb", "a\nb"])
def test_a_name_that_cannot_be_kept_is_refused(name: str) -> None:
    with pytest.raises(InvalidConfig):
        check_name(name)


def test_the_config_of_a_place_is_that_of_a_launch() -> None:
    spec = small_spec(
        overrides={"loop": {"epochs": 3, "batch_size": 64}}, variants=(Variant("b", {"loop": {"batch_size": 32}}),)
    )
    place = Place(Cell("FetchPush", "her", "b"), 1)

    config = make_configs(spec, spec.places)[place]

    by_hand = make_config("FetchPush", "manipulation", "her", 1, "smoke", {"loop": {"epochs": 3, "batch_size": 32}})
    assert config == by_hand


def test_variants_that_are_the_same_training_are_refused() -> None:
    spec = small_spec(variants=(Variant("as it is"), Variant("named", {"replay": {"capacity": 2000}})))

    with pytest.raises(InvalidConfig, match="'as it is' and 'named' are the same training for FetchPush with her"):
        make_configs(spec, spec.places)


def test_a_spec_survives_the_store() -> None:
    spec = small_spec(overrides={"loop": {"epochs": 3}}, variants=(Variant("b", {"agent": {"gamma": 0.9}}),))

    assert spec_from_dict(spec_to_dict(spec)) == spec


def test_the_paper_is_thirteen_tasks_seven_methods_and_five_seeds() -> None:
    paper = TEMPLATES["paper"].spec

    assert paper.tasks == tuple(TASKS)
    assert paper.methods == tuple(METHODS)
    assert paper.size == 13 * 7 * 5
    assert [cell.variant for cell in paper.cells] == [PLAIN] * 91
    assert sum(TEMPLATES[f"paper-{family}"].spec.size for family in FAMILIES) == paper.size


@pytest.mark.parametrize("name", TEMPLATES)
def test_every_template_can_be_launched(name: str) -> None:
    spec = TEMPLATES[name].spec
    check_spec(spec)
    check_name(TEMPLATES[name].title)

    assert len(make_configs(spec, spec.places)) == spec.size


def planned(method: str, seed: int, needs: tuple[str, ...] = (), **overrides) -> PlannedRun:
    config = make_config("FetchPush", "manipulation", method, seed, "smoke", overrides)
    return PlannedRun(config, config_hash(config), "smoke", needs, None)


SMOKE_LIKE = {("smoke",): [Speed(100.0, 2.0), Speed(200.0, 4.0), Speed(1000.0, 40.0)]}


def test_time_is_planned_steps_and_updates_at_the_median_speeds_of_the_nearest_runs() -> None:
    run = planned("her", 0)
    # smoke: a cycle of warm-up, four cycles, two tests; 4 episodes of 50 steps each; 4 updates a cycle
    assert (control_steps(run.config), gradient_updates(run.config)) == ((1 + 4 + 2) * 4 * 50, 16)

    assert Speeds({}, SMOKE_LIKE).seconds_for(run) == pytest.approx(STARTING_S + 1400 / 200.0 + 16 / 4.0)


def test_runs_that_differ_by_the_seed_alone_say_it_best() -> None:
    speeds = Speeds({}, SMOKE_LIKE)
    speeds.seconds_of[settings_hash(planned("her", 5).config)] = [30.0, 50.0, 40.0]

    assert speeds.seconds_for(planned("her", 0)) == 40.0
    assert speeds.seconds_for(planned("her", 0, loop={"epochs": 4})) != 40.0


def test_nobody_knows_where_nothing_alike_has_succeeded() -> None:
    told = estimate([planned("her", 0), planned("her", 1)], Speeds(), slots=2)

    assert (told.training_s, told.until_done_s, told.unknown_runs) == (None, None, 2)


def test_slots_share_the_time_but_a_chain_does_not_get_shorter() -> None:
    first = planned("her", 0)
    behind = planned("her-sldr", 0, needs=(first.config_hash,))
    each = Speeds({}, SMOKE_LIKE).seconds_for(first)
    assert each is not None

    on_one, on_many = (estimate([first, behind], Speeds({}, SMOKE_LIKE), slots) for slots in (1, 8))

    assert on_one.training_s == on_one.until_done_s == on_many.training_s == pytest.approx(2 * each)
    assert on_many.until_done_s == pytest.approx(2 * each)
    assert estimate([first, planned("her", 1)], Speeds({}, SMOKE_LIKE), 2).until_done_s == pytest.approx(each)
    assert estimate([first], Speeds({}, SMOKE_LIKE), 0).until_done_s is None

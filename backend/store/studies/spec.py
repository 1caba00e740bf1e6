"""What a study asks for: its axes, the places that they span, and the config of each place."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from itertools import product
from typing import Any
from unicodedata import category

from backend.store.locomotion import TRAIN
from sldr_core.config import TASKS, TrainConfig, config_hash, find_method
from sldr_core.errors import InvalidConfig, UnknownName
from sldr_core.presets import check_overrides, find_preset, lay_over, make_config

MOST_PLACES = 2000
"""Places that a study may have, locomotion runs not counted; so no axis is longer than this."""
LONGEST_NAME = 80
"""Letters of the name of a study or variant at most."""
LONGEST_NOTE = 10_000
"""Letters of a study's note at most."""
PLAIN = ""
"""The variant of a study that varies no settings."""


@dataclass(frozen=True)
class Variant:
    """Name settings that are tried beside others."""

    name: str
    overrides: Mapping[str, Any] = field(default_factory=dict[str, Any])
    """Settings laid over those of the study, nested."""


@dataclass(frozen=True)
class Cell:
    """Name what the seeds of a study are repeated for."""

    task: str
    method: str
    variant: str = PLAIN


@dataclass(frozen=True)
class Place:
    """Name one training of a study; at most one run stands there."""

    cell: Cell
    seed: int


@dataclass(frozen=True)
class StudySpec:
    """Ask for every combination of tasks, methods, seeds and, if there are any, variants."""

    tasks: tuple[str, ...]
    methods: tuple[str, ...]
    seeds: tuple[int, ...]
    preset: str
    overrides: Mapping[str, Any] = field(default_factory=dict[str, Any])
    """Settings laid over the preset in every run, nested."""
    variants: tuple[Variant, ...] = ()
    """The axis of settings; none if only tasks, methods and seeds vary."""
    locomotion: str = TRAIN
    """Where the locomotion models come from: `zoo`, `train`, or ids of locomotion runs, separated by commas."""

    @property
    def cells(self) -> list[Cell]:
        """Return every cell, task by task."""
        names = [variant.name for variant in self.variants] or [PLAIN]
        return [Cell(*names) for names in product(self.tasks, self.methods, names)]

    @property
    def places(self) -> list[Place]:
        """Return every place, cell by cell."""
        return [Place(cell, seed) for cell in self.cells for seed in self.seeds]

    @property
    def size(self) -> int:
        """Return how many places there are, without naming them."""
        return len(self.tasks) * len(self.methods) * len(self.seeds) * max(1, len(self.variants))


@dataclass(frozen=True)
class Addition:
    """Name what a study shall have besides."""

    tasks: tuple[str, ...] = ()
    methods: tuple[str, ...] = ()
    seeds: tuple[int, ...] = ()
    variants: tuple[Variant, ...] = ()


def extend_spec(spec: StudySpec, addition: Addition) -> StudySpec:
    """Return a spec with longer axes; what it has already is not added twice.

    Raises:
        InvalidConfig: the study varies no settings, so that its runs are of no variant.
    """
    if addition.variants and not spec.variants:
        raise InvalidConfig(
            {
                "variants": "this study varies no settings, so none can be added beside them; launch a new study with "
                "the variants: it takes in the runs of this one that are the same."
            }
        )
    return replace(
        spec,
        tasks=_united(spec.tasks, addition.tasks),
        methods=_united(spec.methods, addition.methods),
        seeds=_united(spec.seeds, addition.seeds),
        variants=spec.variants + tuple(variant for variant in addition.variants if variant not in spec.variants),
    )


def check_spec(spec: StudySpec) -> None:
    """Refuse a study that cannot be launched, whatever its settings are.

    Raises:
        UnknownName: task, method or preset does not exist.
        InvalidConfig: an axis is empty or names something twice, or the study is too large.
    """
    for task in spec.tasks:
        if task not in TASKS:
            raise UnknownName("task", task, TASKS)
    for method in spec.methods:
        find_method(method)
    find_preset(spec.preset)
    for name, values in (("tasks", spec.tasks), ("methods", spec.methods), ("seeds", spec.seeds)):
        _check_axis(name, values)
    _check_names("variants", [variant.name for variant in spec.variants])
    if spec.size > MOST_PLACES:
        raise InvalidConfig(
            {
                "seeds": f"these are {spec.size} runs and a study may have {MOST_PLACES}; "
                "take fewer, or make two studies."
            }
        )
    for overrides in (spec.overrides, *(variant.overrides for variant in spec.variants)):
        check_overrides(overrides)


def check_name(name: str) -> str:
    """Return a name without the space around it.

    Raises:
        InvalidConfig: nothing is left of it, it is too long, or it is not one line.
    """
    (name,) = _check_names("name", [name])
    if name != on_one_line(name):
        raise InvalidConfig({"name": "it holds a tab, a line break or the like; write spaces instead."})
    return name


def on_one_line(name: str) -> str:
    """Return a name with spaces for tabs, line breaks and other characters that control a screen."""
    return "".join(letter if letter >= " " else " " for letter in name)


def check_text(setting: str, text: str, longest: int) -> str:
    """Return a text without the space around it.

    Raises:
        InvalidConfig: it is too long, or holds what no text can.
    """
    text = text.strip()
    if len(text) > longest:
        raise InvalidConfig({setting: f"it may have {longest} letters, and this one has {len(text)}."})
    if any(letter == "\0" or category(letter) == "Cs" for letter in text):
        raise InvalidConfig({setting: "it holds a character that cannot be kept; leave that out."})
    return text


def make_configs(spec: StudySpec, places: Iterable[Place]) -> dict[Place, TrainConfig]:
    """Return the config of each place.

    Raises:
        InvalidConfig: a setting is unknown or cannot work, or two variants are the same training.
    """
    settings = {variant.name: lay_over(spec.overrides, variant.overrides) for variant in spec.variants}
    settings.setdefault(PLAIN, dict(spec.overrides))
    configs = {place: _make_config(spec.preset, place, settings[place.cell.variant]) for place in places}
    _check_differ(configs)
    return configs


def check_variants_differ(spec: StudySpec) -> None:
    """Refuse a variant that is the same training as another, whether or not its runs are there already.

    Raises:
        InvalidConfig: two are the same, or a setting cannot work.
    """
    if spec.variants:
        make_configs(spec, [Place(cell, spec.seeds[0]) for cell in spec.cells])


def spec_to_dict(spec: StudySpec) -> dict[str, Any]:
    """Return a spec as plain JSON values."""
    return asdict(spec)


def spec_from_dict(values: Mapping[str, Any]) -> StudySpec:
    """Return what `spec_to_dict` was given."""
    axes = {name: tuple(values[name]) for name in ("tasks", "methods", "seeds")}
    variants = tuple(Variant(**variant) for variant in values["variants"])
    # Studies from before there was a choice have trained their own.
    return StudySpec(
        **axes,
        preset=values["preset"],
        overrides=values["overrides"],
        variants=variants,
        locomotion=values.get("locomotion", TRAIN),
    )


def _make_config(preset: str, place: Place, overrides: dict[str, Any]) -> TrainConfig:
    cell = place.cell
    try:
        return make_config(cell.task, "manipulation", cell.method, place.seed, preset, overrides)
    except InvalidConfig as err:
        where = f"(for {_described(cell)})"
        raise InvalidConfig({name: f"{problem} {where}" for name, problem in err.problems.items()}) from err


def _check_differ(configs: Mapping[Place, TrainConfig]) -> None:
    seen: dict[str, Place] = {}
    for place, config in configs.items():
        other = seen.setdefault(config_hash(config), place)
        if other != place:
            raise InvalidConfig(
                {
                    "variants": f"'{other.cell.variant}' and '{place.cell.variant}' are the same training for "
                    f"{place.cell.task} with {place.cell.method}; leave one of them out."
                }
            )


def _check_axis(name: str, values: Sequence[object]) -> None:
    if not values:
        raise InvalidConfig({name: "none is given; choose at least one."})
    twice = [value for value, count in Counter(values).items() if count > 1]
    if twice:
        raise InvalidConfig({name: f"{twice[0]} is listed more than once; list each once."})


def _check_names(setting: str, names: Sequence[str]) -> list[str]:
    stripped = [check_text(setting, name, LONGEST_NAME) for name in names]
    if not all(stripped):
        raise InvalidConfig({setting: "a name is empty; give it at least one letter."})
    if stripped:
        _check_axis(setting, stripped)
    return stripped


def _described(cell: Cell) -> str:
    return ", ".join(part for part in (cell.task, cell.method, cell.variant) if part)


def _united(values: tuple[Any, ...], more: tuple[Any, ...]) -> tuple[Any, ...]:
    return tuple(dict.fromkeys((*values, *more)))

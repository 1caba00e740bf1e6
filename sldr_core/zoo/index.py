"""What the zoo holds: `index.json` says for each model which file it is, how it was trained and how well it does."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from sldr_core.config import SceneConfig, TrainConfig, config_from_dict, config_hash, config_to_dict
from sldr_core.disk import write_atomically
from sldr_core.errors import BadFile, InvalidConfig

ZOO_VARIABLE = "SLDR_ZOO"
"""Names another directory of models than the one that comes with the product."""
SHIPPED = Path(__file__).parent / "models"
INDEX_FILE = "index.json"
FORMAT = 1
"""Raised when an older program could not read a newer index."""
LARGEST_MODEL = 64 * 2**20
"""A larger file is no locomotion model of ours [bytes]."""


@dataclass(frozen=True)
class Measurement:
    """How well the shipped file does, over test episodes that no training has seen."""

    successes: int
    episodes: int
    seed: int
    """Of starts and goals."""
    low: float
    high: float
    """The 95 % Wilson interval of the success rate."""

    @property
    def success_rate(self) -> float:
        """Share of successful episodes."""
        return self.successes / self.episodes


@dataclass(frozen=True)
class Origin:
    """How the model was trained."""

    preset: str
    versions: Mapping[str, str]
    """Of the packages whose change could change numbers."""
    machine: str
    wall_s: float | None
    """How long the training took [s]; None if nobody knows."""


@dataclass(frozen=True)
class ZooModel:
    """Describe one shipped locomotion model."""

    name: str
    """Its task, with what differs from the usual scene."""
    path: Path
    size: int
    """Length of its file [bytes]."""
    sha256: str
    config: TrainConfig
    measured: Measurement
    origin: Origin

    @property
    def task(self) -> str:
        """The locomotion task that it was trained in."""
        return self.config.task

    @property
    def goal_kind(self) -> str:
        """Which part of a pose it brings to its goal: `position`, `rotation` or `translation`."""
        if self.config.task_spec.family != "hand":
            return "position"
        return "rotation" if self.config.task_spec.success_angle is not None else "translation"

    def serves(self, config: TrainConfig) -> bool:
        """Tell whether it may stand in for the run of a locomotion config: the same task in the same scene."""
        return self.config.task == config.task and self.config.scene == config.scene

    def check(self) -> None:
        """Refuse a file that is not the one that was measured.

        Raises:
            BadFile: it is gone, or was changed.
        """
        if not self.path.is_file():
            raise BadFile(f"The zoo's model {self.path} is gone; install the product again, or use a run of your own.")
        if self.path.stat().st_size != self.size or checksum(self.path) != self.sha256:
            raise BadFile(
                f"The zoo's model {self.path} is not the one that was measured; install the product again, "
                "or use a run of your own."
            )


def zoo_directory() -> Path:
    """Return where the models lie."""
    return Path(os.environ.get(ZOO_VARIABLE) or SHIPPED)


def read_zoo(directory: Path | None = None) -> dict[str, ZooModel]:
    """Return the models there are by their names, in the order in which they were added; often few, or none.

    Raises:
        BadFile: the index cannot be read.
    """
    directory = directory or zoo_directory()
    path = directory / INDEX_FILE
    if not path.is_file():
        return {}
    try:
        values = json.loads(path.read_text())
        if values["format"] > FORMAT:
            raise BadFile(f"{path} was written by a newer version of this product; update to read it.")
        models = [_model_from_dict(directory, entry) for entry in values["models"]]
    except (AttributeError, KeyError, TypeError, ValueError, InvalidConfig, UnicodeDecodeError) as err:
        raise BadFile(f"{path} cannot be read ({type(err).__name__}: {err}); install the product again.") from err
    return {model.name: model for model in models}


def write_zoo(directory: Path, models: Mapping[str, ZooModel]) -> None:
    """Write the index of a directory of models."""
    content = {"format": FORMAT, "models": [model_to_dict(model) for model in models.values()]}

    def write(path: Path) -> None:
        path.write_text(json.dumps(content, indent=1) + "\n")

    write_atomically(directory / INDEX_FILE, write)


def find_in_zoo(models: Mapping[str, ZooModel], config: TrainConfig) -> ZooModel | None:
    """Return the model that may stand in for the run of a locomotion config, if there is one."""
    return next((model for model in models.values() if model.serves(config)), None)


def name_of(config: TrainConfig) -> str:
    """Return what a model of this config is called in the zoo."""
    usual = SceneConfig()
    differing = (
        config.scene.variant if config.scene.variant != usual.variant else "",
        config.scene.locomotion_robot if config.scene.locomotion_robot != usual.locomotion_robot else "",
    )
    return "-".join(word for word in (config.task, *differing) if word)


def model_to_dict(model: ZooModel) -> dict[str, Any]:
    """Return all that is known about a model as plain JSON values."""
    return {
        "name": model.name,
        "task": model.task,
        "goal_kind": model.goal_kind,
        "file": model.path.name,
        "size": model.size,
        "sha256": model.sha256,
        "success_rate": model.measured.success_rate,
        "measured": asdict(model.measured),
        "origin": {**asdict(model.origin), "versions": dict(model.origin.versions)},
        "config_hash": config_hash(model.config),
        "config": config_to_dict(model.config),
    }


def _model_from_dict(directory: Path, entry: Mapping[str, Any]) -> ZooModel:
    file_name = str(entry["file"])
    if Path(file_name).name != file_name or not 0 < int(entry["size"]) <= LARGEST_MODEL:
        raise ValueError(f"'{file_name}' is no file of a model")
    return ZooModel(
        name=str(entry["name"]),
        path=directory / file_name,
        size=int(entry["size"]),
        sha256=str(entry["sha256"]),
        config=config_from_dict(entry["config"]),
        measured=Measurement(**entry["measured"]),
        origin=Origin(**entry["origin"]),
    )


def checksum(path: Path) -> str:
    """Return the sha256 of a file in hex."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()

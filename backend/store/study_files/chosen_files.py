"""Which files of its runs a study file holds: final policies, locomotion models, and some recorded episodes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from backend.store.files import FileRow
from backend.store.study_files.records import Place
from sldr_core.episodes import epoch_of

BEST_POLICY, NEWEST_POLICY, LOCOMOTION = "policy-best.pt", "policy-newest.pt", "locomotion.pt"
EPISODES = "episodes"
KINDS = {BEST_POLICY: "policy", NEWEST_POLICY: "policy", LOCOMOTION: "locomotion"}

EpisodeChoice = Literal["every", "first-seed", "none"]
"""Which runs' last recorded episodes are packed: of every run, of the first seed of each method, or of none."""


def keeps_episodes(choice: EpisodeChoice, run_id: str, places: Mapping[str, Place]) -> bool:
    """Tell whether a run's recorded episodes are packed.

    Args:
        choice: which runs' are.
        run_id: the run.
        places: where the runs that are packed stand, by their ids; a locomotion run has none, and no seeds beside it.
    """
    here = places.get(run_id)
    if choice == "first-seed" and here is not None:
        beside = [place for place in places.values() if _cell(place) == _cell(here)]
        return here.seed == min(place.seed for place in beside)
    return choice != "none"


def choose_files(files: Sequence[FileRow], with_episodes: bool) -> list[FileRow]:
    """Return the final policy, the model and, if they are wanted, the last recorded episodes of a run."""
    by_name = {file.name: file for file in files}
    policy = next((name for name in (BEST_POLICY, NEWEST_POLICY) if name in by_name), "")
    recorded = max(
        (name for name in by_name if epoch_of(name) is not None), key=lambda name: epoch_of(name) or 0, default=""
    )
    # A locomotion model holds the object's policy, and is what the robot's run has learnt from.
    wanted = (LOCOMOTION if LOCOMOTION in by_name else policy, recorded if with_episodes else "")
    return [by_name[name] for name in wanted if name in by_name]


def kind_of(name: str) -> Any:
    """Return what a file holds, as the study file's list says it."""
    return KINDS.get(name, EPISODES)


def _cell(place: Place) -> tuple[str, str, str]:
    return place.task, place.method, place.variant

"""Studies that are worth launching as they are: the paper's, whole or by family, and one to see what a study is."""

from __future__ import annotations

from dataclasses import dataclass

from backend.store.locomotion import ZOO
from backend.store.studies.spec import StudySpec
from sldr_core.config import METHODS

PAPER_SEEDS = (0, 1, 2, 3, 4)
"""The paper's five (§6.1)."""


@dataclass(frozen=True)
class Template:
    """Name a study that can be launched at once, or be changed first."""

    name: str
    """Short, for addresses and commands."""
    title: str
    """What the study is called."""
    summary: str
    """What it is for, in one sentence for a person."""
    spec: StudySpec


FAMILIES: dict[str, tuple[str, tuple[str, ...]]] = {
    "fetch": ("One object on a table", ("FetchPush", "FetchSlide", "FetchPickAndPlace")),
    "stack": ("Stacks of blocks", ("FetchStack2", "FetchStack3")),
    "tuple": ("Hinged chains", ("FetchTuple3", "FetchTuple5")),
    "hand-rotate": ("Turning in the hand", ("HandEggRotate", "HandBlockRotate", "HandPenRotate")),
    "hand-full": ("Turning and moving in the hand", ("HandEggFull", "HandBlockFull", "HandPenFull")),
}
"""The paper's tasks by what they ask for: title and tasks of each family."""

TWO_MINUTES = StudySpec(
    tasks=("FetchPush",),
    methods=("her", "her-sldr"),
    seeds=(0, 1, 2),
    preset="quick",
    overrides={
        "loop": {
            "epochs": 5,
            "cycles_per_epoch": 2,
            "episodes_per_cycle": 20,
            "updates_per_cycle": 20,
            "batch_size": 256,
            "test_episodes": 20,
        },
        "replay": {"capacity": 60_000},
        "sldr": {"gate": 0.0},
    },
    locomotion=ZOO,
)
"""Six short trainings and the locomotion run that they share: enough to see every page filled, not to learn much."""


def _paper(name: str, title: str, summary: str, tasks: tuple[str, ...]) -> Template:
    return Template(name, title, summary, StudySpec(tasks, tuple(METHODS), PAPER_SEEDS, "paper", locomotion=ZOO))


TEMPLATES: dict[str, Template] = {
    template.name: template
    for template in (
        Template(
            "two-minutes",
            "Two minutes of FetchPush",
            "Two methods and three seeds, too short to learn much: see what a study shows.",
            TWO_MINUTES,
        ),
        _paper(
            "paper",
            "The paper",
            "Every task with every method and five seeds, with the paper's budget.",
            tuple(task for _, tasks in FAMILIES.values() for task in tasks),
        ),
        *(
            _paper(
                f"paper-{family}",
                f"The paper: {title.lower()}",
                f"{', '.join(tasks)}: seven methods, five seeds.",
                tasks,
            )
            for family, (title, tasks) in FAMILIES.items()
        ),
    )
}
"""All templates, by name."""

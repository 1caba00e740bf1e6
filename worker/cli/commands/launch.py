"""`sldr launch`: queue runs, or a whole study of them, for the workers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from typing import Annotated

import tyro

from backend.store import launches
from backend.store.database import Database, open_database
from backend.store.locomotion import ZOO
from backend.store.run_plans import PlannedRun
from backend.store.settings import load_settings
from backend.store.studies.estimate import Estimate, estimate_study
from backend.store.studies.launch import create_study, preview_study
from backend.store.studies.plan import Standing, StudyPlan
from backend.store.studies.spec import StudySpec
from backend.store.studies.templates import TEMPLATES, Template
from backend.store.zoo_runs import ZooShelf
from sldr_core.config import LOCOMOTION_METHOD, Phase, TrainConfig
from sldr_core.errors import InvalidConfig, UnknownName
from worker.cli.seeds import parse_seeds
from worker.cli.settings import parse_settings

WORDS = {Standing.NEW: "new", Standing.JOINED: "reused", Standing.IN_STUDY: "in the study"}
"""How a person reads where a study's runs come from."""


@dataclass(frozen=True)
class Arguments:
    """Queue runs for the workers: one task and method, or with --study or --template every combination of several."""

    task: tyro.conf.UseAppendAction[tuple[str, ...]] = ()
    """A task, as `sldr list tasks` names it; a study may have several."""
    method: tyro.conf.UseAppendAction[tuple[str, ...]] = ()
    """A method, as `sldr list methods` names it; a study may have several (default: her-sldr, for locomotion her)."""
    seeds: Annotated[str | None, tyro.conf.arg(metavar="SEEDS", help_behavior_hint="")] = None
    """Seeds, as in 0 or 0-4 or 1,3,7-9 (default: 0)."""
    phase: Phase = "manipulation"
    """Who acts: the object on its own, or the robot. A study is of the robot, with the locomotion runs it needs."""
    preset: Annotated[str | None, tyro.conf.arg(metavar="STR", help_behavior_hint="")] = None
    """The budget, as `sldr list presets` names it (default: quick)."""
    settings: Annotated[
        tyro.conf.UseAppendAction[tuple[str, ...]], tyro.conf.arg(name="set", metavar="GROUP.NAME=VALUE")
    ] = ()
    """A setting laid over the preset, as in loop.batch_size=256; may be given again."""
    study: Annotated[str | None, tyro.conf.arg(metavar="NAME", help_behavior_hint="")] = None
    """Keep the runs together as a study of this name."""
    template: Annotated[str | None, tyro.conf.arg(metavar="NAME", help_behavior_hint="")] = None
    """Begin with a study that comes with the product: paper, paper-fetch ...; other options then change it."""
    locomotion: str | None = None
    """Where locomotion models come from: zoo, train, or ids of locomotion runs, separated by commas (default: zoo)."""
    dry_run: bool = False
    """Say what would be queued, and queue nothing."""


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    given = tyro.cli(Arguments, prog="sldr launch", args=list(arguments))
    is_study = given.study is not None or given.template is not None
    asked = _study(given) if is_study else _order(given)
    settings = load_settings()
    shelf = ZooShelf(settings)
    with closing(open_database(settings)) as db:
        if isinstance(asked, launches.LaunchOrder):
            _launch(db, asked, shelf, given.dry_run)
        else:
            _launch_study(db, *asked, shelf, given.dry_run)
    return 0


def _launch(db: Database, order: launches.LaunchOrder, shelf: ZooShelf, dry_run: bool) -> None:
    plan = launches.plan_launch(db, order, shelf)
    for planned in plan:
        print(_line(_standing(planned), planned))
    if dry_run:
        return
    for planned, run_id in zip(plan, launches.launch(db, order, shelf), strict=True):
        if planned.reused_run_id is None:
            print(f"{'queued' if planned.model is None else 'imported'} {run_id}")


def _launch_study(db: Database, name: str, spec: StudySpec, shelf: ZooShelf, dry_run: bool) -> None:
    plan = preview_study(db, spec, shelf=shelf)
    print("\n".join(_study_lines(plan, estimate_study(db, plan))))
    if not dry_run:
        launched = create_study(db, name, spec, shelf=shelf)
        print(f"Study {launched.study_id} '{name}': {launched.queued} runs queued, {launched.joined} reused.")


def _order(given: Arguments) -> launches.LaunchOrder:
    method = given.method or (LOCOMOTION_METHOD if given.phase == "locomotion" else TrainConfig().method,)
    for option, values in (("task", given.task), ("method", method)):
        if len(values) != 1:
            raise InvalidConfig({option: f"{len(values)} are given; give one, or name a study with --study."})
    return launches.LaunchOrder(
        task=given.task[0],
        phase=given.phase,
        method=method[0],
        seeds=parse_seeds(given.seeds or "0"),
        preset=given.preset or "quick",
        overrides=parse_settings(given.settings),
        locomotion=given.locomotion or ZOO,
    )


def _study(given: Arguments) -> tuple[str, StudySpec]:
    """Return name and spec of the study that is asked for."""
    if given.phase == "locomotion":
        raise InvalidConfig({"phase": "a study is of the robot and brings the locomotion runs it needs; leave it out."})
    template = None if given.template is None else _find_template(given.template)
    spec = StudySpec((), (TrainConfig().method,), (0,), "quick") if template is None else template.spec
    changes = {
        "tasks": given.task,
        "methods": given.method,
        "seeds": None if given.seeds is None else parse_seeds(given.seeds),
        "preset": given.preset,
        "overrides": parse_settings(given.settings),
        "locomotion": given.locomotion or ZOO,
    }
    name = given.study or (template.title if template else "")
    return name, replace(spec, **{axis: value for axis, value in changes.items() if value})


def _find_template(name: str) -> Template:
    if name not in TEMPLATES:
        raise UnknownName("template", name, TEMPLATES)
    return TEMPLATES[name]


def _standing(run: PlannedRun) -> str:
    if run.reused_run_id is not None:
        return "reused"
    return "new" if run.model is None else "zoo"


def _line(standing: str, run: PlannedRun) -> str:
    return f"{standing:8} {run.task:18} {run.phase:13} {run.method:10} seed {run.seed}"


def _study_lines(plan: StudyPlan, estimate: Estimate) -> Iterable[str]:
    """Return what a study would do, cell by cell."""
    for run in plan.locomotion:
        yield _line(_standing(run), run)
    for cell in plan.spec.cells:
        standings = Counter(planned.standing for planned in plan.places if planned.place.cell == cell)
        told = ", ".join(f"{count} {WORDS[standing]}" for standing, count in standings.items())
        yield f"{cell.task:18} {cell.method:10} {cell.variant:10} {told}".rstrip()
    yield f"{len(plan.new_runs)} to be queued, {_described(estimate)}, {estimate.disk_bytes / 1e9:.1f} GB of disk."


def _described(estimate: Estimate) -> str:
    if estimate.training_s is None:
        return f"nobody knows how long yet ({estimate.unknown_runs} are unlike any that succeeded here)"
    return f"about {estimate.training_s / 3600:.1f} h of training"

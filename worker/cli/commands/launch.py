"""`sldr launch`: queue runs, or a whole study of them, for the workers."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Annotated

import tyro
from pydantic import TypeAdapter

from backend.client.records.runs import Run
from backend.client.records.studies import Standing, StudyEstimate, StudyPreview, StudySpec, Variant
from backend.client.waiting import wait_for_runs
from backend.store.studies.templates import TEMPLATES, Template
from sldr_core.config import LOCOMOTION_METHOD, Phase, TrainConfig
from sldr_core.errors import InvalidConfig, UnknownName
from sldr_core.presets import lay_over
from worker.cli.seeds import parse_seeds
from worker.cli.service import Order, Server, Service, open_service
from worker.cli.settings import parse_settings

WORDS: dict[Standing, str] = {"new": "new", "joined": "reused", "in_study": "in the study"}
"""How a person reads where a study's runs come from."""

NOT_ALL_SUCCEEDED = 1
"""Exit code when runs were waited for, and some have not succeeded."""


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
    variant: Annotated[tyro.conf.UseAppendAction[tuple[tuple[str, str], ...]], tyro.conf.arg(metavar="NAME JSON")] = ()
    """Settings of a study that are tried beside others: a name, then JSON such as {"loop": {"batch_size": 256}}."""
    locomotion: Annotated[str, tyro.conf.arg(metavar="zoo|train|RUN,...")] = "zoo"
    """Where locomotion models come from: the zoo where it has them, all trained here, or these locomotion runs."""
    dry_run: bool = False
    """Say what would be queued, and queue nothing."""
    wait: bool = False
    """Wait until all of it has ended, and tell every change; the exit code is 1 if a run has not succeeded."""
    server: Server = None
    """The service to ask, as in http://127.0.0.1:8000 (default: SLDR_URL, else what runs here, else the store)."""


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    given = tyro.cli(Arguments, prog="sldr launch", args=list(arguments))
    if given.wait and given.dry_run:
        raise InvalidConfig({"wait": "a dry run queues nothing that could be waited for; leave one of them out."})
    is_study = given.study is not None or given.template is not None
    asked = _study(given) if is_study else _order(given)
    with open_service(given.server) as service:
        if isinstance(asked, Order):
            run_ids = _launch(service, asked, given.dry_run)
        else:
            run_ids = _launch_study(service, *asked, given.dry_run)
        return _wait(service, run_ids) if given.wait else 0


def _launch(service: Service, order: Order, dry_run: bool) -> list[str]:
    plan = service.plan(order)
    for planned in plan:
        standing = _source(planned.reused_run_id, planned.zoo_success)
        repeated = f", repeats {planned.equal_run_id}" if planned.equal_run_id else ""
        print(f"{standing:8} {planned.task:18} {planned.phase:13} {planned.method:10} seed {planned.seed}{repeated}")
    if dry_run:
        return []
    launched = service.launch(order)
    reused = {planned.reused_run_id for planned in plan}
    for run in launched:
        if run.id not in reused:
            print(f"queued {run.id}")
    return [run.id for run in launched]


def _launch_study(service: Service, name: str, spec: StudySpec, dry_run: bool) -> list[str]:
    print("\n".join(_study_lines(service.preview_study(spec))), flush=True)
    if dry_run:
        return []
    launched = service.create_study(name, spec)
    print(f"Study {launched.study_id} '{name}': {launched.queued} runs queued, {launched.joined} reused.")
    return service.study_run_ids(launched.study_id)


def _wait(service: Service, run_ids: Sequence[str]) -> int:
    """Wait for the end of runs, telling every change; return the exit code."""
    ended = wait_for_runs(service.get_run, run_ids, on_change=lambda run: print(_standing(run), flush=True))
    good = sum(run.state == "succeeded" for run in ended)
    print(f"{good} of {len(ended)} runs succeeded.")
    return 0 if good == len(ended) else NOT_ALL_SUCCEEDED


def _standing(run: Run) -> str:
    why = f": {run.reason}" if run.reason else ""
    return f"{run.id} {run.task} {run.phase} {run.method} seed {run.seed} is {run.state}{why}"


def _order(given: Arguments) -> Order:
    if given.variant:
        raise InvalidConfig({"variant": "only a study has variants; name one with --study."})
    method = given.method or (LOCOMOTION_METHOD if given.phase == "locomotion" else TrainConfig().method,)
    for option, values in (("task", given.task), ("method", method)):
        if len(values) != 1:
            raise InvalidConfig({option: f"{len(values)} are given; give one, or name a study with --study."})
    return Order(
        task=given.task[0],
        phase=given.phase,
        method=method[0],
        seeds=parse_seeds(given.seeds or "0"),
        preset=given.preset or "quick",
        settings=parse_settings(given.settings),
        locomotion=given.locomotion,
    )


def _study(given: Arguments) -> tuple[str, StudySpec]:
    """Return name and spec of the study that is asked for."""
    if given.phase == "locomotion":
        raise InvalidConfig({"phase": "a study is of the robot and brings the locomotion runs it needs; leave it out."})
    template = None if given.template is None else _find_template(given.template)
    spec = StudySpec([], [TrainConfig().method], [0], "quick") if template is None else _spec_of(template)
    changes = {
        "tasks": list(given.task),
        "methods": list(given.method),
        "seeds": None if given.seeds is None else list(parse_seeds(given.seeds)),
        "preset": given.preset,
        "overrides": lay_over(spec.overrides, parse_settings(given.settings)),
        "locomotion": given.locomotion,
        "variants": [_variant(name, overrides) for name, overrides in given.variant],
    }
    name = given.study or (template.title if template else "")
    spec = replace(spec, **{axis: value for axis, value in changes.items() if value})
    if not spec.tasks:
        raise InvalidConfig({"tasks": "none is given; name at least one with --task."})
    return name, spec


def _variant(name: str, overrides: str) -> Variant:
    try:
        read = json.loads(overrides)
    except json.JSONDecodeError:
        read = None
    if not isinstance(read, dict):
        example = '{"loop": {"batch_size": 256}}'
        raise InvalidConfig({"variant": f"'{overrides}' is no set of settings in JSON, such as {example}"})
    return Variant(name, read)


def _find_template(name: str) -> Template:
    if name not in TEMPLATES:
        raise UnknownName("template", name, TEMPLATES)
    return TEMPLATES[name]


def _spec_of(template: Template) -> StudySpec:
    return TypeAdapter(StudySpec).validate_python(asdict(template.spec))


def _study_lines(preview: StudyPreview) -> Iterable[str]:
    """Return what a study would do, cell by cell."""
    for run in preview.locomotion:
        yield f"{_source(run.run_id, run.zoo_success):8} {run.task:18} locomotion"
    cells: dict[tuple[str, str, str], Counter[Standing]] = {}
    for place in preview.places:
        cells.setdefault((place.task, place.method, place.variant), Counter())[place.standing] += 1
    for (task, method, variant), standings in cells.items():
        told = ", ".join(f"{count} {WORDS[standing]}" for standing, count in standings.items())
        yield f"{task:18} {method:10} {variant:10} {told}".rstrip()
    disk = f"{preview.estimate.disk_bytes / 1e9:.1f} GB of disk"
    yield f"{preview.queued} to be queued, {_described(preview.estimate)}, {disk}."


def _source(reused_run_id: str | None, zoo_success: float | None) -> str:
    if reused_run_id is not None:
        return "reused"
    return "new" if zoo_success is None else "zoo"


def _described(estimate: StudyEstimate) -> str:
    if estimate.training_s is None:
        return f"nobody knows how long yet ({estimate.unknown_runs} are unlike any that succeeded here)"
    return f"about {estimate.training_s / 3600:.1f} h of training"

"""Whether a study file fits together, before anything of it is written anywhere."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping

from pydantic import ValidationError

from backend.store.run_plans import RUN_ID_LENGTH
from backend.store.states import Event
from backend.store.studies.launch import STUDY_ID_LENGTH
from backend.store.studies.spec import LONGEST_NAME, Cell, Place, check_name, check_spec, make_configs, spec_from_dict
from backend.store.study_files.archive import HostileArchive
from backend.store.study_files.records import (
    LARGEST_SEED,
    STUDY_MEMBER,
    Curves,
    RunRecord,
    StudyFile,
    file_member,
    metrics_member,
)
from backend.store.study_files.rows import StudyRows
from sldr_core.config import TrainConfig, config_from_dict
from sldr_core.episodes import TAGS, epoch_of
from sldr_core.errors import BadFile, SldrError
from sldr_core.presets import find_preset

LARGEST_LIST = 64 * 2**20
"""Of `study.json` [bytes]."""
EVENTS = frozenset(Event)


def read_study(archive: HostileArchive, called: str) -> StudyRows:
    """Return the rows that a study file stands for.

    Args:
        called: what the user calls the file.

    Raises:
        BadFile: it is no study file, or does not fit together, or not with this version.
    """
    listed = archive.read(STUDY_MEMBER, LARGEST_LIST)
    digest = hashlib.sha256(listed).hexdigest()
    content = _parsed(listed, called)
    try:
        spec = spec_from_dict(content.study.spec.model_dump())
        check_spec(spec)
        make_configs(spec, spec.places)
        name = check_name(content.study.name[:LONGEST_NAME])
        configs = {run.key: config_from_dict(run.config) for run in content.runs}
        for run in content.runs:
            find_preset(run.preset)
    except (SldrError, AttributeError, KeyError, TypeError, ValueError, RecursionError) as err:
        raise BadFile(f"{called} asks for what this version does not have: {err!s:.300}.") from err
    problem = next(_problems(content, configs, set(spec.places)), None)
    if problem is not None:
        raise BadFile(f"{called} does not fit together: {problem}; it is not taken.")
    files = [file_member(run.key, file.name) for run in content.runs for file in run.files]
    archive.expect([STUDY_MEMBER, *files, *(metrics_member(run.key) for run in content.runs)])
    ids = {key: hashlib.sha256(f"{digest}:{key}".encode()).hexdigest()[:RUN_ID_LENGTH] for key in configs}
    return StudyRows(digest[:STUDY_ID_LENGTH], name, content, spec, configs, ids, digest)


def read_curves(archive: HostileArchive, run: RunRecord, called: str) -> Curves:
    """Return the curves of a run.

    Raises:
        BadFile: they are not those that were promised, or do not fit together.
    """
    packed = archive.read_member(metrics_member(run.key), run.metrics)
    try:
        curves = Curves.model_validate_json(packed)
    except ValidationError as err:
        raise BadFile(f"The curves of run {run.key} in {called} cannot be read; they are not taken.") from err
    cycles = [step[0] for step in curves.steps]
    if cycles != sorted(set(cycles)):
        raise BadFile(f"The cycles of run {run.key} in {called} are not in their order; it is not taken.")
    for name, curve in curves.metrics.items():
        if len(curve.at) != len(curve.values) or curve.at != sorted(set(curve.at)) or curve.at[-1:] >= [len(cycles)]:
            raise BadFile(f"The curve {name} of run {run.key} in {called} does not fit its cycles; it is not taken.")
    return curves


def _parsed(listed: bytes, called: str) -> StudyFile:
    try:
        return StudyFile.model_validate_json(listed)
    except ValidationError as err:
        first = err.errors(include_url=False)[0]
        where = ".".join(str(part) for part in first["loc"]) or STUDY_MEMBER
        raise BadFile(f"{called} is no study file that this version reads: {where:.200}: {first['msg']:.200}.") from err


def _problems(content: StudyFile, configs: Mapping[str, TrainConfig], free: set[Place]) -> Iterator[str]:
    """Tell all that does not fit; `free` are the places of the study that no run stands at yet."""
    if len(configs) != len(content.runs):
        yield "a run is there twice"
    for run in content.runs:
        for problem in (*_needs(run, configs), *_standing(run, configs[run.key], free), *_contents(run)):
            yield f"run {run.key} {problem}"


def _needs(run: RunRecord, configs: Mapping[str, TrainConfig]) -> Iterator[str]:
    if any(key not in configs or configs[key].phase != "locomotion" for key in run.needs):
        yield "needs a locomotion run that is not there"
    if len(set(run.needs)) != len(run.needs) or run.key in run.needs:
        yield "needs a run twice"


def _standing(run: RunRecord, config: TrainConfig, free: set[Place]) -> Iterator[str]:
    if config.seed > LARGEST_SEED:
        yield "has a seed that is too large"
    if run.place is None:
        if config.phase != "locomotion":
            yield "stands nowhere in the study"
        return
    place = Place(Cell(run.place.task, run.place.method, run.place.variant), run.place.seed)
    said = (run.place.task, run.place.method, run.place.seed)
    if place not in free or config.phase != "manipulation" or said != (config.task, config.method, config.seed):
        yield "stands where it cannot"
    free.discard(place)


def _contents(run: RunRecord) -> Iterator[str]:
    names = [file.name for file in run.files]
    if len(set(names)) != len(names):
        yield "has a file twice"
    if len({(episode.epoch, episode.number) for episode in run.episodes}) != len(run.episodes):
        yield "has an episode twice"
    for episode in run.episodes:
        if episode.file not in names or epoch_of(episode.file) != episode.epoch or episode.tag not in TAGS:
            yield f"has an episode of epoch {episode.epoch} that no file holds"
    if not all(event.event in EVENTS for event in run.events):
        yield "has had something happen that cannot"

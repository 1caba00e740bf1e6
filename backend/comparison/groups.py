"""Which runs belong together: the same method, settings and locomotion models, whatever their task and seed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from backend.comparison.records import Group, LeftOut
from backend.comparison.variants import PRESET, Variant, distinguishing, label
from backend.store.compared_runs import ComparedRun
from sldr_core.config import LOCOMOTION_TASKS, METHODS, TASKS

PALETTE_ORDER = ("her-sldr", "her", "her-rnd", "cher", "her-dense", "ddpg-sldr", "ddpg")
"""Who gets which colour and dash: the paper's own method the plainest line, those close to it the most different."""
DASHES = 7
"""Dash patterns of the palette; beyond, they begin anew."""


@dataclass(frozen=True)
class Grouping:
    """Hold runs sorted into groups and tasks."""

    groups: list[Group]
    """In the order of the legend."""
    cells: dict[tuple[str, str], list[ComparedRun]]
    """Runs by task and group key, one a seed, ascending; tasks in the paper's order."""
    left_out: list[LeftOut]

    @property
    def tasks(self) -> list[str]:
        """The tasks that there are runs of, in the paper's order."""
        return list(dict.fromkeys(task for task, _ in self.cells))

    def of_task(self, task: str) -> list[tuple[str, list[ComparedRun]]]:
        """Return group keys and runs of a task, in the order of the legend."""
        return [(group.key, self.cells[task, group.key]) for group in self.groups if (task, group.key) in self.cells]


def group_runs(
    runs: Sequence[ComparedRun], variants: Mapping[str, Variant], models: Mapping[str, str] | None = None
) -> Grouping:
    """Sort runs into groups; of several with the same task, group and seed one stays.

    It is one that went to its end, if there is one, else one that has logged something; of equals the newest.

    Args:
        variants: the settings by which each run deviates from its preset, by run id.
        models: what the locomotion models are called that runs have learnt from, by run id.
    """
    whole = {run.id: ((PRESET, run.preset), *variants[run.id]) for run in runs}
    names = sorted(distinguishing(whole.values()))
    words = _with_models(runs, {run.id: label(whole[run.id], names) for run in runs}, models or {})
    groups = _make_groups({(run.method, words[run.id]) for run in runs})
    keys = {(group.method, group.variant): group.key for group in groups}
    cells: dict[tuple[str, str], list[ComparedRun]] = {}
    left_out: list[LeftOut] = []
    for run in sorted(runs, key=_place):
        key = keys[run.method, words[run.id]]
        cell = cells.setdefault((run.task, key), [])
        if cell and cell[-1].seed == run.seed:
            left_out.append(_duplicate(run, key, cell[-1]))
        else:
            cell.append(run)
    return Grouping(groups, cells, left_out)


def _with_models(runs: Sequence[ComparedRun], words: Mapping[str, str], models: Mapping[str, str]) -> dict[str, str]:
    """Return the words for each run, with its models where runs of the same task, method and words differ in those."""
    alike: dict[tuple[str, str, str], set[str]] = {}
    for run in runs:
        if run.id in models:
            alike.setdefault((run.task, run.method, words[run.id]), set()).add(models[run.id])
    told: dict[str, str] = {}
    for run in runs:
        parts = [words[run.id]] if words[run.id] else []
        if run.id in models and len(alike[run.task, run.method, words[run.id]]) > 1:
            parts.append(f"locomotion {models[run.id]}")
        told[run.id] = ", ".join(parts)
    return told


def _place(run: ComparedRun) -> tuple[int, str, int, bool, int, int]:
    """Return where a run stands: by task and seed, then those that went to their end, then the newest."""
    tasks = [*TASKS, *LOCOMOTION_TASKS]
    order = tasks.index(run.task) if run.task in tasks else len(tasks)
    return order, run.task, run.seed, run.state != "succeeded", run.newest_step_id == 0, -run.number


def _make_groups(kinds: set[tuple[str, str]]) -> list[Group]:
    methods = [*METHODS, *sorted({method for method, _ in kinds} - set(METHODS))]
    groups: list[Group] = []
    # Beside other methods a colour says which one it is; variants of a single one can each have their own.
    is_alone = len({method for method, _ in kinds}) == 1
    painted = [*PALETTE_ORDER, *(method for method in methods if method not in PALETTE_ORDER)]
    for method in methods:
        index = painted.index(method)
        title = METHODS[method].title if method in METHODS else method
        for place, variant in enumerate(sorted(variant for of, variant in kinds if of == method)):
            groups.append(
                Group(
                    key=f"{method}|{variant}" if variant else method,
                    method=method,
                    variant=variant,
                    label=f"{title} ({variant})" if variant else title,
                    color=index + place if is_alone else index,
                    dash=(index + place) % DASHES,
                )
            )
    return groups


def _duplicate(run: ComparedRun, key: str, kept: ComparedRun) -> LeftOut:
    reason = f"It repeats seed {run.seed}, of which run {kept.id} is shown."
    return LeftOut(run_id=run.id, task=run.task, group=key, seed=run.seed, reason=reason)

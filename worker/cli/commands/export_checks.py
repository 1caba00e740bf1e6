"""Refusing to export nothing: the name that nobody knows is told, with what there is."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence

from backend.client.records import comparisons
from backend.comparison import records
from sldr_core.errors import InvalidConfig, UnknownName

WHERE_THEY_ARE = "`sldr runs` lists what there is"


def check_runs(asked: Sequence[str], found: Collection[str]) -> None:
    """Refuse a choice that no run passes, or not each of those that it names.

    Args:
        asked: the runs that it names.
        found: those that pass.

    Raises:
        InvalidConfig: there is none.
    """
    missing = next((run_id for run_id in asked if run_id not in found), None)
    if missing is not None:
        raise InvalidConfig({"run": f"no '{missing}' passes these options, --phase among them; {WHERE_THEY_ARE}"})
    if not found:
        raise InvalidConfig({"runs": f"none passes these options; {WHERE_THEY_ARE}"})


def check_metric(
    curves: records.CurveComparison | comparisons.CurveComparison, list_names: Callable[[], Iterable[str]]
) -> None:
    """Refuse curves without a point.

    Args:
        curves: what was asked for.
        list_names: returns what the runs have logged.

    Raises:
        UnknownName: the runs have logged other metrics.
        InvalidConfig: they have logged nothing yet.
    """
    if any(member.points for panel in curves.panels for curve in panel.curves for member in curve.members):
        return
    names = list(list_names())
    if names:
        raise UnknownName("metric of these runs", curves.metric, names)
    raise InvalidConfig({"runs": "they have logged nothing yet"})

"""Which locomotion models the robot's runs have learnt from; runs of one config may differ in nothing else."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from backend.comparison.variants import PLACES, Variant, as_text
from backend.store.compared_runs import ComparedRun
from sldr_core.config import flatten


def name_models(
    runs: Sequence[ComparedRun], configs: Mapping[str, Mapping[str, Any]], anonymous: bool = False
) -> dict[str, str]:
    """Return what each run has learnt from, by run id; runs that have learnt from nothing known are left out.

    A locomotion run that was trained anew with the same config, wherever, is the same model; it bears the first id.

    Args:
        configs: those of the locomotion runs, by run id.
        anonymous: whether to number the models instead, as ids may tell who made them.
    """
    names: dict[Variant, str] = {}
    for run_id in sorted(configs):
        names.setdefault(_training(configs[run_id]), str(len(names) + 1) if anonymous else run_id)
    called = {run_id: names[_training(config)] for run_id, config in configs.items()}
    learnt_from = {run.id: [called[run_id] for run_id in run.needs if run_id in called] for run in runs}
    return {run_id: " + ".join(sorted(of_run)) for run_id, of_run in learnt_from.items() if of_run}


def _training(config: Mapping[str, Any]) -> Variant:
    """Return all settings but those of the machine."""
    return tuple(sorted((name, as_text(value)) for name, value in flatten(config).items() if name not in PLACES))

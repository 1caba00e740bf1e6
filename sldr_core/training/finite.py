"""Stopping at the first number that is not finite: by its name, and with what it came from."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import torch
from torch import Tensor

from sldr_core.errors import TrainingDiverged
from sldr_core.nets.transitions import Transitions
from sldr_core.records import Episodes

Evidence = Mapping[str, Any]
"""Tensors and plain values by name, nested."""


class NonFinite(TrainingDiverged):
    """Report a number that is not finite.

    Attributes:
        culprit: what it is the number of.
        value: the number.
        evidence: what it came from.
    """

    def __init__(self, culprit: str, value: float, evidence: Evidence) -> None:
        super().__init__(f"{culprit} became {value}.")
        self.culprit = culprit
        self.value = value
        self.evidence = evidence


def check_update(
    metrics: Mapping[str, Tensor],
    batch: Transitions,
    rewards: Mapping[str, Tensor],
    learner_states: Callable[[], Mapping[str, Any]],
) -> None:
    """Look at an update that was just made.

    Args:
        metrics: its scalars by name; nothing can be wrong with anything else while they are all finite.
        batch: what it learnt from.
        rewards: `[B]` by the name of the stream.
        learner_states: returns the states of everything that learns, by name.

    Raises:
        NonFinite: something is not finite; its evidence is the batch.
    """
    if _is_finite(torch.stack([value.float() for value in metrics.values()])):
        return
    parts = {name: getattr(batch, name) for name in ("obs", "next_obs", "goal", "action", "reward")}
    parts.update(batch.extra)
    evidence = {
        **parts,
        "rewards": dict(rewards),
        "metrics": {name: float(value) for name, value in metrics.items()},
    }
    # What comes first can be the cause of what comes later, not the other way round.
    suspects = [
        *((f"'{name}' of the batch", value) for name, value in parts.items()),
        *((f"the reward of stream '{name}'", value) for name, value in rewards.items()),
        *((name, value) for name, value in metrics.items() if not name.endswith("weight_norm")),
        *_weights(learner_states()),
        *metrics.items(),
    ]
    _accuse(suspects, evidence)


def check_weights(learner_states: Mapping[str, Any]) -> None:
    """Look at every weight, statistic and moment.

    Raises:
        NonFinite: one is not finite; its evidence is the tensor that it is in.
    """
    for name, value in _weights(learner_states):
        if not _is_finite(value):
            _accuse([(name, value)], {name: value})


def check_episodes(episodes: Episodes) -> None:
    """Look at what was collected.

    Raises:
        NonFinite: the first number of an episode that is not finite; its evidence are the episodes that have any.
    """
    arrays = {
        "obs": episodes.obs,
        "achieved": episodes.achieved,
        "goal": episodes.goal[:, None],
        "action": episodes.action,
    }
    bad = {name: ~np.isfinite(array).all(axis=2) for name, array in arrays.items()}
    if not any(where.any() for where in bad.values()):
        return
    # An action comes after the observation of its step.
    found = [
        (int(step), name == "action", int(simulation), name)
        for name, where in bad.items()
        for simulation, step in np.argwhere(where).tolist()
    ]
    step, _, simulation, name = min(found)
    chosen = sorted({simulation for _, _, simulation, _ in found})
    evidence = {key: torch.from_numpy(array[chosen]) for key, array in arrays.items()}
    value = torch.from_numpy(arrays[name][simulation, step])
    _accuse([(f"'{name}' of simulation {simulation} at step {step}", value)], {"simulations": chosen, **evidence})


def check_metrics(metrics: Mapping[str, float]) -> None:
    """Look at what is about to be logged.

    Raises:
        NonFinite: a number is not finite.
    """
    _accuse([(name, torch.tensor(value)) for name, value in metrics.items()], {"metrics": dict(metrics)})


def _accuse(suspects: Sequence[tuple[str, Tensor]], evidence: Evidence) -> None:
    """Raise for the first suspect that has a number that is not finite."""
    for culprit, value in suspects:
        if not _is_finite(value):
            number = float(value[~torch.isfinite(value)].flatten()[0])
            raise NonFinite(culprit, number, _on_cpu(evidence))


def _weights(states: Mapping[str, Any], path: str = "") -> Iterator[tuple[str, Tensor]]:
    """Return the floating-point tensors of nested states with the way to each."""
    for name, value in states.items():
        if isinstance(value, Tensor) and value.is_floating_point():
            yield f"{path}{name}", value
        elif isinstance(value, Mapping):
            yield from _weights(value, f"{path}{name}.")


def _is_finite(value: Tensor) -> bool:
    return bool(torch.isfinite(value).all())


def _on_cpu(value: Any) -> Any:
    if isinstance(value, Tensor):
        return value.detach().cpu().clone()
    return {name: _on_cpu(part) for name, part in value.items()} if isinstance(value, Mapping) else value

"""Weights in half precision: a policy or a locomotion model takes half the room, and is loaded as float32.

Normalisers stay as they are: their sums are too large for half precision.
"""

from __future__ import annotations

from pathlib import Path

from torch import Tensor

from sldr_core.errors import BadFile
from sldr_core.nets.files import load_tensors, pack_tensors
from sldr_core.nets.locomotion_model import KIND as LOCOMOTION_KIND
from sldr_core.training.policy import POLICY_KIND

NORMALIZERS = ("normalizer.", "transition_normalizer.")


def read_halved(path: Path) -> bytes:
    """Return a policy or a locomotion model as a file that keeps its networks in half precision.

    Raises:
        BadFile: it is neither, or a weight is too large for half precision.
    """
    content = load_tensors(path, POLICY_KIND, LOCOMOTION_KIND)
    part = "actor" if content["kind"] == POLICY_KIND else "nets"
    return pack_tensors({**content, part: halve(content[part], path)})


def halve(nets: dict[str, Tensor], source: Path) -> dict[str, Tensor]:
    """Return weights in half precision, and normalisers as they are.

    Args:
        nets: the state of networks, by name.
        source: where it comes from, as an error names it.

    Raises:
        BadFile: a weight is too large for half precision.
    """
    halved = {name: value if name.startswith(NORMALIZERS) else value.half() for name, value in nets.items()}
    for name, value in halved.items():
        if not bool(value.isfinite().all()):
            raise BadFile(
                f"{source} cannot be kept in half precision: {name} holds a number that is too large; take another "
                "run's, or one that was trained with a lower agent.learning_rate."
            )
    return halved

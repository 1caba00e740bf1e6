"""Reading files of weights as data alone: nothing in them is ever executed."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import torch

from sldr_core.errors import BadFile


def load_tensors(path: Path, *kinds: str) -> dict[str, Any]:
    """Read a file of tensors and plain values.

    Args:
        path: the file.
        kinds: what the file may call itself.

    Raises:
        BadFile: it is missing, truncated, corrupt or of another kind.
    """
    if not path.is_file():
        raise BadFile(f"There is no file {path}; give the path of a {' or '.join(kinds)}.")
    try:
        content = torch.load(path, map_location="cpu", weights_only=True)
    except (RuntimeError, pickle.UnpicklingError, EOFError, BadZipFile, ValueError, KeyError) as err:
        raise BadFile(f"{path} is corrupt or no file of ours; restore it from a copy or train again.") from err
    kind = content.get("kind") if isinstance(content, dict) else None
    if kind not in kinds:
        raise BadFile(f"{path} holds a {kind or 'foreign object'}, but a {' or '.join(kinds)} is needed.")
    return content

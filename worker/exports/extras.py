"""Libraries that only some installations have."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from sldr_core.errors import SldrError


class ExtraMissing(SldrError):
    """Report a library that has to be installed first."""


def load_extra(module: str, extra: str) -> ModuleType:
    """Return a module that an extra brings.

    Raises:
        ExtraMissing: it is not installed; the message says how to get it.
    """
    try:
        return import_module(module)
    except ModuleNotFoundError as err:
        raise ExtraMissing(
            f"'{module.partition('.')[0]}' is not installed; install this package with its extra '{extra}', "
            f"in its directory: pip install '.[{extra}]'."
        ) from err

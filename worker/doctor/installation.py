"""Is everything installed, in the versions that this product was tested with?"""

from __future__ import annotations

import re
from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, requires, version
from pathlib import Path

from worker.doctor.finding import Finding, ok, poor, wrong

BUILT_PAGE = Path(__file__).parents[2] / "web" / "dist" / "index.html"
"""The page, once it is built."""
NAMED_AT_MOST = 5
"""Packages that one sentence names."""
REINSTALL = "install them anew: `make run` in the checkout, or `pip install --requirement requirements.lock`."

_PINNED = re.compile(r"^([A-Za-z0-9._-]+)(?:\[[^\]]*\])?==([^;\s]+)$")


def look_at_versions() -> Finding:
    """Compare what is installed with what this version asks for."""
    return compare_versions(requires("sldr") or [], version)


def compare_versions(requirements: Sequence[str], installed_version=version) -> Finding:  # noqa: ANN001
    """Compare pinned requirements, extras left out, with what is installed.

    Args:
        requirements: as packages write them, such as `numpy==2.4.6`.
        installed_version: returns the version of a package, or raises PackageNotFoundError.
    """
    pinned = [match.groups() for text in requirements if (match := _PINNED.match(text.strip()))]
    missing: list[str] = []
    others: list[str] = []
    for name, wanted in pinned:
        try:
            found = installed_version(name)
        except PackageNotFoundError:
            missing.append(name)
            continue
        # A build for some graphics card or none is the same version: 2.13.0+cpu.
        if found.partition("+")[0] != wanted:
            others.append(f"{name} {found} instead of {wanted}")
    if missing:
        return wrong("versions", f"Packages are missing: {_named(missing)}.", REINSTALL)
    if others:
        return poor("versions", f"Other versions than tested: {_named(others)}.", REINSTALL)
    return ok("versions", f"sldr {version('sldr')}, and all {len(pinned)} packages as tested.")


def look_at_page(index: Path = BUILT_PAGE) -> Finding:
    """See whether the page was built."""
    if index.is_file():
        return ok("page", f"The page is built ({index.parent}).")
    return wrong("page", f"The page is not built: {index} is missing.", "build it with `make web`; it needs Node.js.")


def _named(words: Sequence[str]) -> str:
    shown, more = words[:NAMED_AT_MOST], len(words) - NAMED_AT_MOST
    return ", ".join(shown) + (f" and {more} more" if more > 0 else "")

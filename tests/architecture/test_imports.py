"""Light packages stay light, and every exported name exists."""

from __future__ import annotations

import importlib
import pkgutil
import subprocess
import sys

import pytest

ROOMS = ("sldr_core", "backend", "worker")
HEAVY = ("torch", "mujoco", "rerun", "viser", "matplotlib")
LIGHT_MODULES = ("sldr_core", "sldr_core.config", "sldr_core.presets", "backend.store", "backend.api.app")
TIMEOUT_S = 60

PACKAGES = sorted(
    package.name
    for room in ROOMS
    for package in pkgutil.walk_packages(importlib.import_module(room).__path__, f"{room}.")
    if package.ispkg
)


@pytest.mark.parametrize("module", LIGHT_MODULES)
def test_light_modules_load_nothing_heavy(module: str) -> None:
    code = f"import sys, {module}; print(*[name for name in {HEAVY} if name in sys.modules])"

    loaded = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=TIMEOUT_S, check=True
    ).stdout.split()

    assert loaded == []


@pytest.mark.parametrize("package", [*ROOMS, *PACKAGES])
def test_exported_names_exist(package: str) -> None:
    module = importlib.import_module(package)

    assert [name for name in getattr(module, "__all__", []) if not hasattr(module, name)] == []


@pytest.mark.parametrize("package", [*ROOMS, *PACKAGES])
def test_no_name_is_exported_twice(package: str) -> None:
    names = list(getattr(importlib.import_module(package), "__all__", []))

    assert len(names) == len(set(names))

"""What every session process needs, imported once: the processes are forked from one that has it all.

PyTorch and MuJoCo take seconds to import; a page should open in less.
"""

from __future__ import annotations

import importlib

from worker.mortality import end_with_parent

NEEDED = ("torch", "mujoco", "trimesh", "viser", "worker.viewer.session", "worker.viewer.live")
"""Modules that are slow to import, or that every session imports."""

# Importing takes seconds, in which the process that forks sessions would not see that its host is gone.
end_with_parent()
for name in NEEDED:
    importlib.import_module(name)

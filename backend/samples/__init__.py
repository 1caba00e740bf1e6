"""What comes with the product to be looked at: the sample study, with real results."""

from __future__ import annotations

import os
from pathlib import Path

SAMPLE_VARIABLE = "SLDR_SAMPLE_STUDY"
"""Names another study file than the one that comes with the product."""
SHIPPED = Path(__file__).parent / "study.zip"


def sample_study() -> Path | None:
    """Return the study file that comes with the product, if it comes with one."""
    path = Path(os.environ.get(SAMPLE_VARIABLE) or SHIPPED)
    return path if path.is_file() else None

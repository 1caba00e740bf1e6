"""What comes with the product to be looked at: sample studies, with real results."""

from __future__ import annotations

import os
from pathlib import Path

SAMPLE_VARIABLE = "SLDR_SAMPLE_STUDY"
"""Names another study file than those that come with the product, or a directory of them."""
SHIPPED = Path(__file__).parent
PATTERN = "*.zip"


def sample_studies() -> tuple[Path, ...]:
    """Return the study files that come with the product, in the order of their names; there may be none."""
    path = Path(os.environ.get(SAMPLE_VARIABLE) or SHIPPED)
    return (path,) if path.is_file() else tuple(sorted(path.glob(PATTERN)))

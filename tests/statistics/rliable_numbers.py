"""What rliable answered; `make_rliable_numbers.py` says how it was asked."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np


def load_numbers() -> dict[str, np.ndarray]:
    """Return scores and answers by name."""
    text = (Path(__file__).parent / "data" / "rliable.json").read_text(encoding="utf-8")
    return {name: np.array(value) for name, value in json.loads(text).items()}

"""Ask rliable for the numbers that the tests of statistics compare with, and write them beside this file.

rliable 1.2.0 cannot be imported beside pandas 3, so it is asked once, in an environment of its own:

    python3.11 -m venv /tmp/rliable && /tmp/rliable/bin/pip install rliable==1.2.0 "pandas<3"
    /tmp/rliable/bin/python tests/statistics/make_rliable_numbers.py
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

REPEATS = 20_000
"""Bootstrap draws; their error is a tenth of that of the 2,000 that are tested."""

FILE = Path(__file__).parent / "data" / "rliable.json"


def main() -> None:
    """Write the scores asked about, and the answers."""
    from rliable import library, metrics  # pyright: ignore[reportMissingImports]

    rng = np.random.default_rng(7)
    first = np.round(rng.beta(5, 2, size=(5, 4)), 3)
    second = np.round(rng.beta(3, 3, size=(5, 4)), 3)
    curves = np.round(np.sort(rng.random((5, 1, 6)), axis=2), 3)
    thresholds = np.linspace(0.0, 1.0, 11)
    random = np.random.RandomState(1)

    def ask(scores, statistic):
        return library.get_interval_estimates(scores, statistic, reps=REPEATS, random_state=random)

    iqm, iqm_interval = ask({"a": first}, lambda x: np.array([metrics.aggregate_iqm(x)]))
    better, better_interval = ask(
        {"a,b": (first, second)}, lambda x, y: np.array([metrics.probability_of_improvement(x, y)])
    )
    frames, frames_interval = ask(
        {"a": curves}, lambda x: np.array([metrics.aggregate_iqm(x[..., frame]) for frame in range(x.shape[-1])])
    )
    profile, profile_interval = library.create_performance_profile({"a": first}, thresholds, reps=REPEATS)
    answers = {
        "first": first,
        "second": second,
        "curves": curves[:, 0, :],
        "thresholds": thresholds,
        "iqm": [iqm["a"][0], *iqm_interval["a"][:, 0]],
        "improvement": [better["a,b"][0], *better_interval["a,b"][:, 0]],
        "curve_iqm": [frames["a"], *frames_interval["a"]],
        "profile": [profile["a"], *profile_interval["a"]],
    }
    plain = {name: np.asarray(value).tolist() for name, value in answers.items()}
    FILE.write_text(json.dumps(plain, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

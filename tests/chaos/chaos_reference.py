"""Train runs one after the other, undisturbed, and write down their curves: `python chaos_reference.py DIRECTORY`."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from sldr_core.config import config_from_dict
from sldr_core.training import DirectoryRecorder, train


def main() -> None:
    """Read `runs.json`, write `curves.json`."""
    root = Path(sys.argv[1])
    curves: dict[str, dict[str, list[float]]] = {}
    for run in json.loads((root / "runs.json").read_text()):
        directory = root / run["id"]
        models = [root / needed / "locomotion.pt" for needed in run["needs"]]
        train(config_from_dict(run["config"]), DirectoryRecorder(directory), models)
        curves[run["id"]] = _curves_of(directory)
    (root / "curves.json").write_text(json.dumps(curves))


def _curves_of(directory: Path) -> dict[str, list[float]]:
    curves: dict[str, list[float]] = {}
    for line in (directory / "metrics.jsonl").read_text().splitlines():
        for name, value in json.loads(line)["metrics"].items():
            curves.setdefault(name, []).append(value)
    return curves


if __name__ == "__main__":
    main()

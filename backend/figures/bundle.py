"""Everything that a reader may ask for in one archive: figures, numbers, configs, versions, seeds, references."""

from __future__ import annotations

import io
import json
import platform
import sys
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from backend.comparison.records import BestModels, Cell, CurveComparison
from backend.figures.csv_tables import best_csv, curves_csv, plain_csv, write_csv
from backend.figures.drawing import Drawing, Format, draw_apart
from backend.figures.latex import best_latex, curves_latex
from backend.figures.references import REFERENCES
from backend.figures.styles import Width
from sldr_core.config import flatten

FORMATS: tuple[Format, ...] = ("svg", "pdf", "png")
PACKAGES = ("sldr", "numpy", "torch", "mujoco", "mjbatch", "gymnasium", "gymnasium-robotics", "matplotlib")
"""What decides the numbers and the figures."""

FIRST_DAY = (1980, 1, 1, 0, 0, 0)
"""The time of every file in the archive: equal content gives equal bytes, and no clue when it was made."""

WHERE = "compute"
"""The group of settings that tells of the machine."""


@dataclass(frozen=True)
class Bundle:
    """Hold what a bundle is made of."""

    curves: CurveComparison
    best: BestModels
    configs: Mapping[str, dict[str, Any]]
    """Of each run, by its id."""
    anonymous: bool
    """Whether to leave out whatever may tell who made it and where."""
    width: Width = "double"
    log_x: bool = False
    """Whether curves are drawn over a logarithmic axis."""
    log_y: bool = False


def make_bundle(bundle: Bundle) -> bytes:
    """Return the archive.

    Raises:
        DrawingFailed: the figures cannot be drawn.
    """
    names = _run_names(bundle)
    drawings = {
        f"figures/{name}.{format}": Drawing(content, format, bundle.width, bundle.log_x, bundle.log_y)
        for name, content in (("curves", bundle.curves), ("best", bundle.best))
        for format in FORMATS
    }
    files: dict[str, bytes | str] = dict(zip(drawings, draw_apart(list(drawings.values())), strict=True))
    files |= {
        "README.md": _readme(bundle),
        "data/curves.csv": curves_csv(bundle.curves),
        "data/best.csv": best_csv(bundle.best),
        "data/runs.csv": _runs_csv(bundle, names),
        "tables/best.tex": best_latex(bundle.best),
        "tables/curves.tex": curves_latex(bundle.curves),
        "references.bib": REFERENCES,
        "versions.json": _as_json(_versions(bundle.anonymous)),
    }
    files |= {f"tables/{table.name}.csv": plain_csv(table) for table in bundle.best.tables}
    files |= {
        f"configs/{names[run_id]}.json": _as_json(_config(config, bundle.anonymous))
        for run_id, config in bundle.configs.items()
        if run_id in names
    }
    return _zip(files)


def _run_names(bundle: Bundle) -> dict[str, str]:
    """Return what each run is called in the bundle: by its id, or by its number where that would tell who made it."""
    ids = [member.run_id for panel in bundle.curves.panels for curve in panel.curves for member in curve.members]
    return {run_id: f"run-{number:04d}" if bundle.anonymous else run_id for number, run_id in enumerate(ids, start=1)}


def _runs_csv(bundle: Bundle, names: Mapping[str, str]) -> str:
    groups = {group.key: group for group in bundle.curves.groups}
    rows: list[list[Cell]] = []
    for panel in bundle.curves.panels:
        for curve in panel.curves:
            of_group: list[Cell] = [panel.task, groups[curve.group].method, groups[curve.group].variant]
            rows += [[names[run.run_id], *of_group, run.seed, str(run.state), run.points] for run in curve.members]
    return write_csv(("run", "task", "method", "variant", "seed", "state", "points"), rows)


def _config(config: Mapping[str, Any], anonymous: bool) -> dict[str, Any]:
    """Return a config; the settings of the machine are left out of an anonymous one, but for the precision."""
    if not anonymous:
        return dict(config)
    precision = flatten(config).get(f"{WHERE}.precision")
    return {**config, WHERE: {"precision": precision}}


def _versions(anonymous: bool) -> dict[str, str]:
    found = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found if anonymous else {**found, "platform": sys.platform, "machine": platform.machine()}


def _readme(bundle: Bundle) -> str:
    words = bundle.curves.words
    return f"""# Comparison of {bundle.curves.runs} runs

| part | what it holds |
|---|---|
| `figures/` | learning curves and best models as SVG, PDF and PNG |
| `data/curves.csv`, `data/best.csv` | exactly the numbers that are drawn |
| `data/runs.csv` | every run with its task, method, seed and state |
| `tables/` | LaTeX (booktabs) and CSV tables |
| `configs/` | the whole config of every run |
| `versions.json` | versions of what computed the numbers |
| `references.bib` | the method and the statistics |

Curves: {words.metric} over {words.x.lower()}; {words.statistic}. Best models: {bundle.best.words.statistic}.
Runs left out: {len(bundle.curves.left_out)}. Hash of the data: {bundle.curves.version}.
"""


def _as_json(value: object) -> str:
    return json.dumps(value, indent=2, sort_keys=True) + "\n"


def _zip(files: Mapping[str, bytes | str]) -> bytes:
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as target:
        for name in sorted(files):
            info = zipfile.ZipInfo(name, FIRST_DAY)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = 0o644 << 16
            target.writestr(info, files[name])
    return archive.getvalue()

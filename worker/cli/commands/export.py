"""`sldr export`: figures, the bundle behind them, and runs for other tools."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from pathlib import Path
from typing import Annotated, Literal, cast

import tyro

from backend.comparison.best import compare_best
from backend.comparison.curves import compare_curves
from backend.comparison.memory import ComparisonMemory
from backend.comparison.records import BestModels, CurveComparison
from backend.figures.bundle import make_bundle
from backend.figures.csv_tables import best_csv, curves_csv
from backend.figures.drawing import Drawing, Format, draw_apart
from backend.figures.gathering import gather_bundle
from backend.figures.latex import best_latex, curves_latex
from backend.figures.styles import Width
from backend.store.compared_runs import ComparedRun, RunChoice, find_compared_runs
from backend.store.curves import list_metric_names
from backend.store.database import Database, open_database
from backend.store.runs import get_runs
from backend.store.settings import load_settings
from backend.store.study_files.chosen_files import EpisodeChoice
from backend.store.study_files.packing import pack_study
from sldr_core.disk import write_atomically
from sldr_core.errors import InvalidConfig, UnknownName
from worker.cli.commands.export_checks import check_metric, check_runs
from worker.cli.commands.export_choice import Chosen, Runs, View
from worker.cli.commands.export_from_server import (
    fetch_bundle,
    fetch_exported,
    fetch_figure,
    fetch_recording,
    find_named_server,
)
from worker.cli.commands.export_rerun import export_rerun
from worker.cli.service import Server
from worker.cli.study_source import open_source
from worker.exports.exported_run import ExportedRun, load_exported

FIGURES = ("svg", "pdf", "png", "csv", "tex")


def main(arguments: Sequence[str]) -> int:
    """Run the command; `--rerun RUN OUT` and `--study ID OUT` may be written with dashes, too."""
    is_dashed = arguments[:1] in (["--rerun"], ["--study"])
    given = [arguments[0].lstrip("-"), *arguments[1:]] if is_dashed else list(arguments)
    kinds: dict[str, Callable[..., int]] = {
        "figure": figure,
        "bundle": bundle,
        "study": study,
        "rerun": rerun,
        "tensorboard": tensorboard,
        "mlflow": mlflow,
    }
    return tyro.extras.subcommand_cli_from_dict(kinds, prog="sldr export", args=given)


def figure(out: Path, runs: Runs, view: View, kind: Literal["curves", "best"] = "curves") -> int:
    """Draw one figure, or write the numbers behind it.

    Args:
        out: The file to write; its ending says what: .svg, .pdf, .png, .csv or .tex.
        runs: Which runs.
        view: How they are shown.
        kind: Learning curves, or bars of best models.
    """
    form = out.suffix.removeprefix(".")
    if form not in FIGURES:
        raise UnknownName("kind of figure", form, FIGURES)
    if (server := runs.named_server()) is not None:
        _check_place(out)
        fetch_figure(server, out, kind, runs.question() | view.question())
        return _tell(out)
    with open_source(runs.study_file) as db:
        memory, choice, shown = ComparisonMemory(), runs.choice(), view.view()
        found = _find(db, choice)
        compare = compare_curves if kind == "curves" else compare_best
        content = compare(db, memory, choice, shown)
        if isinstance(content, CurveComparison):
            check_metric(content, lambda: list_metric_names(db, found))
    return _write(out, _figure_file(content, form, view.width))


def bundle(out: Path, runs: Runs, view: View, anonymous: bool = False) -> int:
    """Pack figures, numbers, configs, versions, seeds and references into one archive.

    Args:
        out: The .zip file to write.
        runs: Which runs.
        view: How they are shown.
        anonymous: Leave out what tells who made it, and where.
    """
    if (server := runs.named_server()) is not None:
        _check_place(out)
        fetch_bundle(server, out, anonymous, runs.question() | view.question())
        return _tell(out)
    with open_source(runs.study_file) as db:
        memory, choice, shown = ComparisonMemory(), runs.choice(), view.view()
        found = _find(db, choice)
        parts = gather_bundle(db, memory, choice, shown, anonymous, view.width)
        check_metric(parts.curves, lambda: list_metric_names(db, found))
    return _write(out, make_bundle(parts))


def study(
    study: tyro.conf.Positional[str],
    out: tyro.conf.Positional[Path],
    episodes_of: EpisodeChoice = "every",
    half: bool = False,
) -> int:
    """Pack a study into one file that `sldr import` takes in elsewhere: curves, configs, policies, a few episodes.

    The study is one of this machine's store; SLDR_URL is not asked.

    Args:
        study: The id of the study.
        out: The .zip file to write.
        episodes_of: Whose recorded episodes go in: those of every run, of the first seed of each method, or none. They
            are a good part of the file.
        half: Keep the weights of policies and locomotion models in half precision: they take half the room, and act
            nearly alike.
    """
    _check_place(out)
    read_weights = Path.read_bytes
    if half:
        from sldr_core.training.halving import read_halved as read_weights
    settings = load_settings()
    with closing(open_database(settings)) as db:
        packed = pack_study(db, settings, study, out, episodes_of, read_weights)
    left_out = f", {packed.left_out} places without a run that has succeeded left out" if packed.left_out else ""
    print(f"{out}: {packed.runs} runs, {packed.size / 1e6:.1f} MB{left_out}")
    return 0


def rerun(run: tyro.conf.Positional[str], out: tyro.conf.Positional[Path], server: Server = None) -> int:
    """Make the Rerun file of a run again from the store: its curves, episodes and log.

    Args:
        run: The id of the run.
        out: The .rrd file to write.
        server: The service whose newest Rerun file of the run is copied instead (default: SLDR_URL, else the store).
    """
    if (named := find_named_server(server)) is not None:
        _check_place(out)
        fetch_recording(named, run, out)
        return _tell(out)
    return export_rerun(run, out)


def tensorboard(out: Path, runs: Runs, overwrite: bool = False) -> int:
    """Write runs as TensorBoard's event files.

    Args:
        out: The directory to write below; each run gets one of its own.
        runs: Which runs.
        overwrite: Replace earlier exports of the same runs.
    """
    from worker.exports.tensorboard import export_to_tensorboard

    for run in _exported(runs):
        print(export_to_tensorboard(run, out, overwrite))
    return 0


def mlflow(uri: Annotated[str, tyro.conf.arg(metavar="URI")], runs: Runs) -> int:
    """Write runs to an MLflow tracking store.

    Args:
        uri: Its address, as MLflow takes it: file:/path, sqlite:////path/mlflow.db or http://host:port.
        runs: Which runs.
    """
    from worker.exports.mlflow import export_to_mlflow

    for run in _exported(runs):
        print(export_to_mlflow(run, uri), run.name)
    return 0


def _exported(runs: Chosen) -> Iterator[ExportedRun]:
    if (server := runs.named_server()) is not None:
        yield from fetch_exported(server, runs.question())
        return
    with open_source(runs.study_file) as db:
        for row in get_runs(db, [run.id for run in _find(db, runs.choice())]):
            yield load_exported(db, row)


def _find(db: Database, choice: RunChoice) -> list[ComparedRun]:
    found = find_compared_runs(db, choice).runs
    check_runs(choice.run_ids, [run.id for run in found])
    return found


def _figure_file(content: CurveComparison | BestModels, form: str, width: Width) -> bytes:
    is_curves = isinstance(content, CurveComparison)
    if form == "csv":
        return (curves_csv(content) if is_curves else best_csv(content)).encode()
    if form == "tex":
        return (curves_latex(content) if is_curves else best_latex(content)).encode()
    [drawn] = draw_apart([Drawing(content, cast(Format, form), width)])
    return drawn


def _write(out: Path, content: bytes) -> int:
    _check_place(out)

    def write(path: Path) -> None:
        path.write_bytes(content)

    write_atomically(out, write)
    return _tell(out)


def _check_place(out: Path) -> None:
    if not out.absolute().parent.is_dir():
        raise InvalidConfig({"out": f"there is no directory {out.absolute().parent}; make it first"})


def _tell(out: Path) -> int:
    print(out)
    return 0

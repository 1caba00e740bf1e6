"""Figures, and the numbers behind them."""

from __future__ import annotations

import csv
import io
import re
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest
from sample_comparison import BEST, CURVES

from backend.comparison.records import BestModels, CurveComparison
from backend.figures import drawing
from backend.figures.bundle import Bundle, make_bundle
from backend.figures.csv_tables import best_csv, curves_csv, plain_csv
from backend.figures.curve_figure import caption
from backend.figures.drawing import Drawing, DrawingFailed, draw_apart
from backend.figures.latex import best_latex, curves_latex, escape
from backend.figures.rendering import render
from backend.figures.styles import COLORS, DASHES, SIZES, Width

PALETTE = Path(__file__).parents[2] / "web" / "src" / "lib" / "palette.ts"


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_figures_have_the_page_s_colours_and_dashes():
    source = PALETTE.read_text(encoding="utf-8")
    light = re.search(r"light: \[([^\]]*)\]", source)
    dashes = re.search(r"const DASHES[^=]*= \[(.*)\];", source)
    assert light is not None
    assert dashes is not None
    assert tuple(re.findall(r"#[0-9a-f]{6}", light[1])) == COLORS
    patterns = re.findall(r"\[([^\]]*)\]", dashes[1])
    assert tuple(tuple(float(n) for n in pattern.split(",") if n.strip()) for pattern in patterns) == DASHES


def test_the_csv_holds_what_is_drawn_with_all_its_digits():
    [curve] = CURVES.panels[0].curves
    aggregate = [row for row in rows(curves_csv(CURVES)) if row["task"] == "FetchPush"]
    assert [float(row["epoch"]) for row in aggregate] == curve.x
    assert [float(row["test/success_rate"]) for row in aggregate] == curve.centre
    assert [float(row["low"]) if row["low"] else None for row in aggregate] == curve.low
    assert [int(row["n"]) for row in aggregate] == curve.n_at
    assert {row["method"] for row in aggregate} == {"her"}


def test_seeds_drawn_by_themselves_are_rows_with_their_seed():
    seeds = [row for row in rows(curves_csv(CURVES)) if row["task"] == "FetchSlide"]
    assert [(row["seed"], row["epoch"], row["test/success_rate"], row["n"]) for row in seeds] == [
        ("4", "1.0", "0.3", "")
    ]


def test_the_csv_of_best_models_holds_bars_and_seeds():
    bar, *seeds = rows(best_csv(BEST))
    assert (bar["seed"], bar["best_success"], bar["low"], bar["high"], bar["n"]) == ("", "0.5", "0.25", "0.75", "3")
    assert [(row["seed"], row["best_success"], row["state"]) for row in seeds] == [("0", "0.5", "succeeded")]


def test_the_caption_tells_of_seeds_drawn_by_themselves():
    several, single = CURVES.panels
    band = "Median, band: quartiles (25 to 75 %)"
    assert caption(replace(CURVES, panels=[several])) == f"{band}; seeds: 3"
    assert caption(replace(CURVES, panels=[single])) == "Each seed by itself; seeds: 1"
    assert caption(CURVES) == f"{band}, each seed by itself where there are fewer than 3; seeds: 1 to 3"
    apart = [
        replace(panel, curves=[replace(curve, has_band=False) for curve in panel.curves]) for panel in CURVES.panels
    ]
    words = replace(CURVES.words, statistic="each seed by itself")
    asked = replace(CURVES, statistic="seeds", words=words, panels=apart)
    assert caption(asked) == "Each seed by itself; seeds: 1 to 3"
    assert caption(replace(CURVES, panels=[])) == "Nothing logged yet"


def test_a_plain_table_becomes_csv():
    assert plain_csv(BEST.tables[0]) == 'Task,Value\n"Fetch, Push",0.1\n'


def test_latex_tables_stand_by_themselves():
    text = best_latex(BEST)
    assert r"FetchPush & \textbf{0.500} [0.250, 0.750] (3) \\" in text
    assert text.count(r"\begin{") == text.count(r"\end{")
    assert r"25 to 75 \%" in text
    assert "FetchPush & 0.600" in curves_latex(CURVES).replace(r"\textbf{0.600}", "0.600")


def test_what_latex_would_read_as_commands_is_escaped():
    assert escape("50 % of a_b & {c} \\d") == r"50 \% of a\_b \& \{c\} \textbackslash{}d"


@pytest.mark.parametrize("width", list(SIZES))
@pytest.mark.parametrize("content", [CURVES, BEST], ids=["curves", "best"])
def test_figures_have_the_width_that_was_asked_for(content: CurveComparison | BestModels, width: Width):
    svg = render(Drawing(content, "svg", width)).decode()
    found = re.search(r'<svg[^>]* width="([\d.]+)pt"', svg)
    assert found is not None
    assert float(found[1]) / 72 == pytest.approx(SIZES[width].width)


def test_the_same_drawing_gives_the_same_bytes_and_embeds_its_fonts():
    first, again = (render(Drawing(BEST, "pdf", "single")) for _ in range(2))
    assert first == again
    assert b"/FontFile2" in first
    assert b"<text" not in render(Drawing(BEST, "svg", "single"))


def test_nothing_to_draw_is_a_figure_too():
    empty = Drawing(CurveComparison(**{**vars(CURVES), "panels": [], "groups": []}), "png", "single", log_x=True)
    assert render(empty).startswith(b"\x89PNG")


def test_a_process_of_its_own_draws_what_this_one_would():
    drawings = [Drawing(CURVES, "svg", "single"), Drawing(BEST, "png", "slide")]
    assert draw_apart(drawings) == [render(one) for one in drawings]


def test_drawing_that_takes_too_long_is_told_in_one_sentence(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(drawing, "DRAWING_S", 0.01)
    with pytest.raises(DrawingFailed, match=r"not drawn within 0\.01 s"):
        draw_apart([Drawing(CURVES, "svg")])


def files_of(monkeypatch: pytest.MonkeyPatch, anonymous: bool) -> dict[str, str]:
    """Make a bundle without drawing."""
    monkeypatch.setattr("backend.figures.bundle.draw_apart", lambda drawings: [b"drawn"] * len(drawings))
    config = {"task": "FetchPush", "seed": 0, "compute": {"device": "cpu", "threads": 7, "precision": "float32"}}
    archive = make_bundle(Bundle(CURVES, BEST, {"run-of-alice": config}, anonymous))
    with zipfile.ZipFile(io.BytesIO(archive)) as content:
        return {name: content.read(name).decode() for name in content.namelist()}


def test_a_bundle_holds_figures_data_configs_versions_seeds_and_references(monkeypatch: pytest.MonkeyPatch):
    files = files_of(monkeypatch, anonymous=False)
    assert {f"figures/{name}.{form}" for name in ("curves", "best") for form in ("svg", "pdf", "png")} <= set(files)
    assert files["data/curves.csv"] == curves_csv(CURVES)
    assert files["data/best.csv"] == best_csv(BEST)
    assert '"threads": 7' in files["configs/run-of-alice.json"]
    assert '"numpy"' in files["versions.json"]
    assert "run-of-alice,FetchPush,her,,0,succeeded,2" in files["data/runs.csv"]
    assert files["references.bib"].count("@") == 2
    assert "tables/scores.csv" in files
    assert "README.md" in files


def test_an_anonymous_bundle_names_neither_runs_nor_machine(monkeypatch: pytest.MonkeyPatch):
    files = files_of(monkeypatch, anonymous=True)
    everything = "\n".join([*files, *files.values()])
    assert "alice" not in everything
    assert "threads" not in everything
    assert '"precision": "float32"' in files["configs/run-0001.json"]
    assert "machine" not in files["versions.json"]

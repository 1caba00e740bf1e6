"""Comparisons through the API: what the page and its exports are given."""

from __future__ import annotations

import csv
import io
import zipfile

import pytest
from live_api import Service, problem_fields
from store_cases import run_on_two_models
from store_samples import SampleSize, fill_store

from backend.figures.drawing import Drawing

SIZE = SampleSize(tasks=("FetchPush",), methods=("her", "ddpg"), seeds=3, epochs=4)


@pytest.fixture(scope="module")
def compared(module_service: Service) -> Service:
    """Return a service with two methods of three seeds."""
    fill_store(module_service.database, SIZE)
    return module_service


def test_curves_come_with_their_words(compared: Service):
    answer = compared.get("/api/compare", params={"x": "env_steps", "statistic": "iqm", "level": 0.8})
    [panel] = answer["panels"]
    assert [group["label"] for group in answer["groups"]] == ["DDPG-Sparse", "HER-Sparse"]
    assert [curve["x"] for curve in panel["curves"]] == [[95e3, 190e3, 285e3, 380e3]] * 2
    assert answer["words"]["x"] == "Environment steps"
    assert "80 % confidence" in panel["curves"][0]["legend"]
    assert panel["curves"][0]["members"][0]["y"] is None


def test_seeds_are_added_when_asked_for(compared: Service):
    answer = compared.get("/api/compare", params={"seeds": True, "method": "her"})
    [curve] = answer["panels"][0]["curves"]
    assert [len(member["y"]) for member in curve["members"]] == [4, 4, 4]
    assert curve["has_band"]


def test_an_answer_says_by_its_version_whether_it_is_new(compared: Service):
    first, again = (compared.get("/api/compare")["version"] for _ in range(2))
    assert first == again


def test_metrics_to_compare_are_listed(compared: Service):
    assert "test/success_rate" in compared.get("/api/compare/metrics")["metrics"]


def test_best_models_come_with_tables(compared: Service):
    answer = compared.get("/api/compare/best")
    assert [table["name"] for table in answer["tables"]] == [
        "scores",
        "overall",
        "improvements",
        "profiles",
        "efficiency",
    ]
    assert [score["n"] for score in answer["scores"]] == [3, 3]


def test_the_csv_is_what_the_page_is_given(compared: Service):
    shown = compared.get("/api/compare", params={"method": "her"})["panels"][0]["curves"][0]
    answer = compared.client.get("/api/compare/figure.csv", params={"method": "her"})
    rows = list(csv.DictReader(io.StringIO(answer.text)))
    assert answer.headers["content-type"].startswith("text/csv")
    assert [float(row["test/success_rate"]) for row in rows] == shown["centre"]
    assert [float(row["high"]) for row in rows] == shown["high"]


def test_latex_comes_as_a_file(compared: Service):
    answer = compared.client.get("/api/compare/figure.tex", params={"kind": "best"})
    assert r"\toprule" in answer.text
    assert 'filename="sldr-best.tex"' in answer.headers["content-disposition"]


def test_a_bundle_is_an_archive_with_every_config(compared: Service, monkeypatch: pytest.MonkeyPatch):
    asked: list[Drawing] = []
    monkeypatch.setattr(
        "backend.figures.bundle.draw_apart", lambda drawings: asked.extend(drawings) or [b"drawn"] * len(drawings)
    )
    answer = compared.client.get("/api/compare/bundle.zip", params={"anonymous": True, "log_x": True, "log_y": True})
    assert {(drawn.log_x, drawn.log_y) for drawn in asked} == {(True, True)}
    with zipfile.ZipFile(io.BytesIO(answer.content)) as archive:
        assert sum(name.startswith("configs/") for name in archive.namelist()) == 6


@pytest.fixture
def with_models(service: Service, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Let runs that differ in nothing but their locomotion model be compared; return the ids of all runs."""
    monkeypatch.setattr(
        "backend.figures.bundle.draw_apart", lambda drawings: [repr(drawn).encode() for drawn in drawings]
    )
    return run_on_two_models(service.database)


def test_an_anonymous_bundle_numbers_locomotion_models(service: Service, with_models: list[str]):
    files = files_of_bundle(service, anonymous=True)
    tables = "\n".join([*files, *(text for name, text in files.items() if not name.startswith("figures/"))])
    assert [run_id for run_id in with_models if run_id in tables] == []
    assert "locomotion 1" in tables
    assert "locomotion 2" in tables
    drawn = files["figures/best.svg"]
    assert [model for model in with_models[:2] if model in drawn] == []


def test_a_bundle_with_names_keeps_those_of_models(service: Service, with_models: list[str]):
    files_of_bundle(service, anonymous=True)
    files = files_of_bundle(service, anonymous=False)
    assert [model for model in with_models[:2] if f"locomotion {model}" not in files["data/curves.csv"]] == []


def files_of_bundle(service: Service, anonymous: bool) -> dict[str, str]:
    answer = service.client.get("/api/compare/bundle.zip", params={"anonymous": anonymous})
    with zipfile.ZipFile(io.BytesIO(answer.content)) as archive:
        return {name: archive.read(name).decode() for name in archive.namelist()}


def test_configs_are_compared(compared: Service):
    runs = [run["id"] for run in compared.get("/api/runs")["runs"]]
    answer = compared.get("/api/compare/configs", params={"run": [runs[0], runs[-1]]})
    assert {setting["name"] for setting in answer["settings"]} == {"method", "seed", "replay.relabel_probability"}
    assert answer["methods"][0]["switches"][0]["name"] == "relabel_probability"


@pytest.mark.parametrize(
    ("params", "field"),
    [({"level": 0.2}, "level"), ({"x": "days"}, "x"), ({"statistic": "best"}, "statistic"), ({"phase": "x"}, "phase")],
)
def test_a_question_that_cannot_work_names_its_field(unused_service: Service, params: dict[str, str], field: str):
    answer = unused_service.client.get("/api/compare", params=params)
    assert (answer.status_code, problem_fields(answer)) == (422, [field])


@pytest.mark.parametrize("path", ["", "/best", "/metrics", "/figure.csv"])
def test_a_study_that_does_not_exist_is_not_found(unused_service: Service, path: str):
    answer = unused_service.client.get(f"/api/compare{path}", params={"study": "nope"})
    assert (answer.status_code, "'nope'" in answer.text) == (404, True)

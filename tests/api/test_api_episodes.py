"""Recorded episodes through the API: their list, the timelines of one, and files that cannot be read."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from live_api import Service
from recorded_tests import made_episode, made_test

from sldr_core.episodes import RecordedTest
from worker.recorder import StoreRecorder


@pytest.fixture
def recorded() -> RecordedTest:
    """Return a test of two episodes; the second is a success."""
    reached = np.array([False, False, True, True, True])
    return made_test(made_episode(0), made_episode(1, tag="success", success=reached))


@pytest.fixture
def run_id(service: Service, recorded: RecordedTest) -> str:
    """Return a run whose tests of two epochs were recorded, as a worker does."""
    service.launch()
    held = service.claim()
    with StoreRecorder(service.database, service.settings, held, lambda: None) as recorder:
        recorder.record_episodes(replace(recorded, origin=replace(recorded.origin, epoch=3)), {3})
        recorder.record_episodes(recorded, {3, 12})
    return held.run_id


def path_of(service: Service, run_id: str) -> Path:
    return service.settings.run_directory(run_id) / "episodes-epoch-0012.npz"


def test_episodes_are_listed_with_how_they_ended(service: Service, run_id: str, recorded: RecordedTest) -> None:
    found = service.get(f"/api/runs/{run_id}/episodes", params={"sort": "success", "limit": 1})

    summary = recorded.summaries()[1]
    assert (found["total"], found["epochs"]) == (4, [3, 12])
    assert found["episodes"] == [
        {
            "epoch": 12,
            "index": 1,
            "attempt": 1,
            "success": True,
            "tag": "success",
            "task_return": summary.task_return,
            "worst_q": summary.worst_q,
            "worst_q_step": summary.worst_q_step,
            "length": 4,
            "resimulates": True,
            "file": "episodes-epoch-0012.npz",
        }
    ]


def test_the_list_is_filtered(service: Service, run_id: str) -> None:
    found = service.get(f"/api/runs/{run_id}/episodes", params={"tag": "other", "epoch": 3})

    assert [(row["epoch"], row["index"]) for row in found["episodes"]] == [(3, 0)]


@pytest.mark.parametrize("query", [{"tag": "lost"}, {"sort": "length"}, {"limit": 0}, {"offset": -1}, {"epoch": 2**40}])
def test_what_cannot_be_asked_for_is_refused(service: Service, run_id: str, query: dict[str, str]) -> None:
    assert service.client.get(f"/api/runs/{run_id}/episodes", params=query).status_code == 422


def test_the_timelines_of_an_episode_are_those_of_its_file(
    service: Service, run_id: str, recorded: RecordedTest
) -> None:
    answer = service.get(f"/api/runs/{run_id}/episodes/12/1")

    episode = recorded.episodes[1]
    assert answer["episode"]["worst_q_step"] == recorded.summaries()[1].worst_q_step
    assert answer["env_steps"] == 1200
    assert answer["distance"] == episode.distance.tolist()
    assert answer["angle"] is None
    assert answer["success"] == [False, False, True, True, True]
    assert answer["contact"] == {"object0": episode.contact[:, 0].tolist()}
    assert list(answer["rewards"]) == list(answer["values"]) == ["task", "sldr/object0"]
    np.testing.assert_array_equal(np.float32(answer["rewards"]["sldr/object0"]), episode.reward[:, 1])
    np.testing.assert_array_equal(np.float32(answer["values"]["task"]), episode.value[:, 0])
    np.testing.assert_array_equal(np.float32(answer["wanted"]["object0"]), episode.wanted[:, 0])
    np.testing.assert_array_equal(np.float32(answer["induced"]["object0"]), episode.induced[:, 0])


@pytest.mark.parametrize("episode", ["12/2", "13/0"])
def test_an_episode_that_was_not_recorded_is_not_found(service: Service, run_id: str, episode: str) -> None:
    answer = service.client.get(f"/api/runs/{run_id}/episodes/{episode}")

    assert answer.status_code == 404
    assert episode.replace("/", ".") in answer.json()["problems"][0]["message"]


def test_a_run_that_does_not_exist_is_not_found(service: Service) -> None:
    assert service.client.get("/api/runs/none/episodes").status_code == 404
    assert service.client.get("/api/runs/none/episodes/1/0").status_code == 404


def test_a_file_cut_short_is_refused_in_one_sentence(service: Service, run_id: str) -> None:
    path = path_of(service, run_id)
    path.write_bytes(path.read_bytes()[:200])

    answer = service.client.get(f"/api/runs/{run_id}/episodes/12/0")

    assert answer.status_code == 422
    (problem,) = answer.json()["problems"]
    assert "is not the file that run" in problem["message"]


def test_a_file_that_is_gone_is_said_to_be_gone(service: Service, run_id: str) -> None:
    path_of(service, run_id).unlink()

    answer = service.client.get(f"/api/runs/{run_id}/episodes/12/0")

    assert answer.status_code == 404
    assert "is gone" in answer.json()["problems"][0]["message"]

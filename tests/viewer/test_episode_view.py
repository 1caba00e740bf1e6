"""A recorded episode in 3D: what is shown at a step is the file's, to the last bit, and so are the curves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import viser
from prepared import STEPS, record, save_model

from sldr_core.episodes import read_episodes, write_episodes
from sldr_core.errors import BadFile
from worker.viewer.commands import BadCommand, Command
from worker.viewer.episode import EpisodeShow, open_episode
from worker.viewer.page import open_page
from worker.viewer.reports import Job


@pytest.fixture(scope="module")
def server() -> Iterator[viser.ViserServer]:
    server = open_page()
    yield server
    server.stop()


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Path, ...]]:
    home = tmp_path_factory.mktemp("episodes")
    write_episodes(home / "episodes-epoch-0002.npz", record("FetchPush")[0])
    return {
        "episodes": (home / "episodes-epoch-0002.npz",),
        "locomotion": (save_model("FetchPush", home / "locomotion.pt"),),
    }


def job(files: dict[str, tuple[Path, ...]], index: int = 0) -> Job:
    return Job("session", {"kind": "episode", "epoch": 2, "index": index}, files)


@pytest.fixture(scope="module")
def show(server, files) -> EpisodeShow:
    show = open_episode(server, job(files))
    assert isinstance(show, EpisodeShow)
    return show


def test_every_step_shown_is_that_of_the_file(show, files):
    [episode] = read_episodes(files["episodes"][0]).episodes
    for step in (0, 7, STEPS, 3):
        show.transport.seek(step)
        show.advance(0.0)
        assert show.report()["qpos"].tolist() == episode.qpos[step].tolist()
        assert show.report()["qvel"].tolist() == episode.qvel[step].tolist()


def test_the_curves_are_the_file_s(show, files):
    [episode] = read_episodes(files["episodes"][0]).episodes
    columns = show.obey(Command("timeline", {}))["columns"]
    assert columns["q/object0"] == episode.reward[:, 1].tolist()
    assert columns["reward/task"] == episode.reward[:, 0].tolist()
    assert columns["value/task"] == episode.value[:, 0].tolist()
    assert columns["distance/goal"] == pytest.approx(episode.distance, abs=1e-6)
    assert columns["contact/object0"] == episode.contact[:, 0].astype(float).tolist()
    assert len(columns["distance/demonstration of object0"]) == STEPS


def test_the_worst_q_is_gone_to(show, files):
    [episode] = read_episodes(files["episodes"][0]).episodes
    answer = show.obey(Command("worst", {}))
    assert answer == {"step": int(episode.reward[:, 1].argmin())}
    assert show.transport.step == answer["step"]


def test_it_simulates_to_the_same_bits_again_or_says_where_it_does_not(show):
    assert show.obey(Command("resimulate", {})) == {"equal": True, "step": None}


def test_the_ghost_is_off_one_step_ahead_or_whole(show):
    show.transport.seek(5)
    ahead = show.report()["ghost_qpos"]["object0"]
    show.obey(Command("ghost", {"mode": "whole", "from": 5}))
    show.transport.seek(6)
    assert np.array_equal(show.report()["ghost_qpos"]["object0"], ahead)
    show.obey(Command("ghost", {"mode": "off"}))
    assert show.report()["ghost_qpos"] == {}
    show.obey(Command("ghost", {"mode": "step"}))


def test_the_way_of_a_whole_demonstration_is_drawn_once(show, server, monkeypatch):
    drawn: list[str] = []
    draw = server.scene.add_line_segments

    def add(name: str, *arguments: object, **options: object) -> object:
        drawn.append(name)
        return draw(name, *arguments, **options)

    monkeypatch.setattr(server.scene, "add_line_segments", add)
    show.obey(Command("ghost", {"mode": "whole", "from": 5}))
    for step in (6, 7, 8):
        show.transport.seek(step)
        show.advance(0.0)
    show.obey(Command("ghost", {"mode": "whole", "from": 6}))
    show.advance(0.0)
    assert drawn.count("/ghost/object0/path") == 2
    show.obey(Command("ghost", {"mode": "step"}))


def test_what_it_cannot_do_is_refused_with_what_it_can(show):
    with pytest.raises(BadCommand, match="arrows, ghost, resimulate, timeline, worst"):
        show.obey(Command("push", {}))
    with pytest.raises(BadCommand, match='has to be "off" or "step" or "whole"'):
        show.obey(Command("ghost", {"mode": "upside down"}))


def test_a_file_that_is_cut_short_is_named(server, files, tmp_path):
    path = tmp_path / "episodes-epoch-0002.npz"
    path.write_bytes(files["episodes"][0].read_bytes()[:500])
    with pytest.raises(BadFile, match=r"episodes-epoch-0002\.npz is cut short"):
        open_episode(server, job({"episodes": (path,)}))


def test_an_episode_that_the_file_has_not_got_is_named(server, files):
    with pytest.raises(BadFile, match="has no episode 4; it has 0"):
        open_episode(server, job(files, index=4))


def test_a_model_of_another_task_is_named(server, files, tmp_path):
    other = save_model("FetchSlide", tmp_path / "locomotion.pt")
    with pytest.raises(BadFile, match="is a locomotion model of FetchSlide; FetchPush needs one of FetchPush"):
        open_episode(server, job({**files, "locomotion": (other,)}))


def test_states_of_another_scene_are_named(server, tmp_path):
    test, episode = record("FetchPush")
    cut = replace(episode, qpos=episode.qpos[:, :-1])
    write_episodes(tmp_path / "e.npz", replace(test, episodes=(cut,)))
    with pytest.raises(BadFile, match="holds states of another scene than FetchPush"):
        open_episode(server, job({"episodes": (tmp_path / "e.npz",)}))

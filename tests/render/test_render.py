"""Pictures of the tasks: drawn by a process of its own, checked, and a clear sentence where that cannot work."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from sldr_core.config import TASKS
from sldr_core.errors import UnknownName
from worker import render
from worker.drawing import EmptyPicture, check_frame

GOAL_IS_RED = (150, 70)
"""Least red, and most green and blue, of the goal marker."""
UNLIKE_THE_AIR = 12
"""Difference from the colour behind the scene, of 255."""


OF_EACH_KIND = ("FetchPush", "FetchStack2", "FetchTuple3", "HandEggRotate")
"""Drawn in the usual run; the slow one draws all."""


@pytest.mark.parametrize(
    "task", [pytest.param(task, marks=() if task in OF_EACH_KIND else pytest.mark.slow) for task in TASKS]
)
def test_a_task_s_picture_has_its_size_and_shows_the_goal(tmp_path, task):
    render.render_task_picture(task, tmp_path / "picture.png")
    with Image.open(tmp_path / "picture.png") as picture:
        assert picture.size == render.PICTURE_SIZE
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    check_frame(pixels.astype(np.uint8))
    if TASKS[task].family == "hand":
        # The goal of a hand is a translucent copy of the object; beside the hand where only its rotation counts.
        shown = np.abs(pixels - pixels[0, 0]).max(axis=-1) > UNLIKE_THE_AIR
        assert shown[:, pixels.shape[1] // 2 :].sum() > 1000
        return
    red = (pixels[..., 0] > GOAL_IS_RED[0]) & (pixels[..., 1:] < GOAL_IS_RED[1]).all(axis=-1)
    assert red.sum() > 100


def test_only_missing_pictures_are_drawn(tmp_path):
    pictures = {task: tmp_path / "pictures" / f"{task}.png" for task in TASKS}
    pictures["FetchPush"].parent.mkdir()
    for task in pictures.keys() - {"FetchPush"}:
        pictures[task].write_text("drawn before")

    assert render.render_all_pictures(tmp_path) == [pictures["FetchPush"]]

    assert all(path.read_text() == "drawn before" for task, path in pictures.items() if task != "FetchPush")
    with Image.open(pictures["FetchPush"]) as picture:
        assert picture.size == render.PICTURE_SIZE


def test_what_killed_drawings_left_is_removed_and_nothing_of_those_at_work(tmp_path):
    pictures = tmp_path / "pictures"
    pictures.mkdir()
    for task in TASKS:
        (pictures / f"{task}.png").write_text("drawn before")
    left, at_work = pictures / ".drawing-left", pictures / ".drawing-at-work"
    for folder in (left, at_work):
        folder.mkdir()
        (folder / "picture.png").touch()
    os.utime(left, (0.0, 0.0))

    assert render.render_all_pictures(tmp_path) == []

    assert (left.exists(), at_work.exists()) == (False, True)


def test_a_drawing_that_ended_since_the_directory_was_listed_is_no_error(tmp_path):
    pictures = tmp_path / "pictures"
    pictures.mkdir()
    for task in TASKS:
        (pictures / f"{task}.png").write_text("drawn before")
    # Listed, but gone when it is looked at.
    (pictures / ".drawing-ended").symlink_to(pictures / "gone")

    assert render.render_all_pictures(tmp_path) == []


def test_a_picture_takes_the_size_asked_for_and_leaves_nothing_beside_it(tmp_path):
    path = tmp_path / "new" / "push.png"
    render.render_task_picture("FetchPush", path, 160, 90)
    with Image.open(path) as picture:
        assert picture.size == (160, 90)
    assert list(path.parent.iterdir()) == [path]


def test_a_frame_of_one_colour_is_refused():
    with pytest.raises(EmptyPicture):
        check_frame(np.zeros((4, 4, 3), dtype=np.uint8))


def test_an_unknown_task_is_named_before_anything_is_started(tmp_path):
    with pytest.raises(UnknownName, match="No task is called 'FetchPus'"):
        render.render_task_picture("FetchPus", tmp_path / "x.png")


def test_missing_egl_is_one_sentence_with_the_packages(monkeypatch, tmp_path):
    monkeypatch.setattr(render, "EGL_LIBRARY", "libEGL-that-is-not-there.so.1")
    with pytest.raises(render.RenderFailed) as caught:
        render._draw_here("FetchPush", tmp_path / "x.png", 64, 64)
    assert "apt-get install -y libegl1 libegl-mesa0 libgl1-mesa-dri" in str(caught.value)
    assert "\n" not in str(caught.value)
    assert "MUJOCO_GL" not in os.environ


def test_a_machine_without_an_egl_device_gets_the_same_sentence(monkeypatch, tmp_path):
    monkeypatch.setenv("MUJOCO_EGL_DEVICE_ID", "999")
    with pytest.raises(render.RenderFailed, match="libegl-mesa0"):
        render.render_task_picture("FetchPush", tmp_path / "x.png", 64, 64)
    assert list(tmp_path.iterdir()) == []


def test_the_command_says_in_one_sentence_what_is_wrong(tmp_path):
    command = [sys.executable, "-m", "worker.render", "FetchPus", str(tmp_path / "x.png")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 3
    assert done.stderr.startswith("error: No task is called 'FetchPus'. Did you mean 'FetchPush'?")
    assert len(done.stderr.splitlines()) == 1

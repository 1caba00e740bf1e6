"""Draw a scene with MuJoCo's own renderer. Needs a process of its own that was started with MUJOCO_GL=egl."""

from __future__ import annotations

from contextlib import closing
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from sldr_core.config import find_task
from sldr_core.envs import make_envs
from sldr_core.errors import SldrError
from worker.viewer.camera import Camera, find_camera
from worker.viewer.dress import dress, goal_sites

PICTURE_SEED = 3
"""A start in which gripper, object and goal stand well apart."""

OVERSAMPLING = 2
"""Pictures are drawn this many times larger, then scaled down: smooth edges."""

MIN_CONTRAST = 4.0
"""A frame whose brightness varies less than this was not drawn, of 255."""

VIDEO_SHADOW_SIZE = 2048
"""Side of the map of shadows in videos [pixels]."""

VIDEO_SAMPLES = 2
"""Samples per pixel in videos."""


class EmptyPicture(SldrError):
    """Report that the renderer returned a frame with nothing on it."""


def draw_task(task: str, width: int, height: int) -> Image.Image:
    """Draw the start of an episode of a task, with its goal.

    Raises:
        UnknownName: no such task.
        EmptyPicture: nothing was drawn.
    """
    spec = find_task(task)
    envs = make_envs(task, seed=PICTURE_SEED, testing=True)
    goal = envs.observe().goal[0]
    size = (OVERSAMPLING * width, OVERSAMPLING * height)
    frame = draw(envs.model, envs.qpos[0], goal, find_camera(spec, "manipulation"), *size)
    return Image.fromarray(frame).resize((width, height), Image.Resampling.LANCZOS)


def draw(
    model: mujoco.MjModel,
    qpos: NDArray[np.floating],
    goal: NDArray[np.floating],
    camera: Camera,
    width: int,
    height: int,
) -> NDArray[np.uint8]:
    """Draw one moment of a scene as `[height, width, 3]`; `SceneDrawing.frame` says what is what.

    Raises:
        EmptyPicture: nothing was drawn.
    """
    with closing(SceneDrawing(model, camera, width, height)) as drawing:
        frame = drawing.frame(qpos, goal)
    check_frame(frame)
    return frame


class SceneDrawing:
    """Draw moments of one scene. Make, use and close it in one thread: in another, frames come out black."""

    def __init__(self, model: mujoco.MjModel, camera: Camera, width: int, height: int, is_video: bool = False) -> None:
        self._model = dress(model)
        self._model.vis.global_.offwidth, self._model.vis.global_.offheight = width, height
        self._model.vis.global_.fovy = camera.field_of_view
        if is_video:
            # Nobody sees the difference while it moves, and without a graphics card it takes half the time.
            self._model.vis.quality.shadowsize, self._model.vis.quality.offsamples = VIDEO_SHADOW_SIZE, VIDEO_SAMPLES
        self._data = mujoco.MjData(self._model)
        self._camera = camera.as_mujoco()
        untyped: Any = mujoco.Renderer(self._model, height=height, width=width)
        self._renderer = untyped

    def frame(self, qpos: NDArray[np.floating], goal: NDArray[np.floating]) -> NDArray[np.uint8]:
        """Draw one moment as `[height, width, 3]`.

        Args:
            qpos: joint positions, `[nq]`.
            goal: the task's goal, `[G]`: positions of the markers [m]; a hand's target is drawn where `qpos` has it.
        """
        self._data.qpos[:] = qpos
        _place_goal(self._model, self._data, goal)
        self._renderer.update_scene(self._data, self._camera)
        return self._renderer.render().copy()

    def close(self) -> None:
        """Give the renderer back."""
        self._renderer.close()


def check_frame(frame: NDArray[np.uint8]) -> None:
    """Refuse a frame of one colour: that is what a renderer without a working context returns.

    Raises:
        EmptyPicture: it is of one colour.
    """
    if float(frame.std()) < MIN_CONTRAST:
        raise EmptyPicture(
            "The renderer returned a frame of one colour; check the machine's EGL driver (libgl1-mesa-dri)."
        )


def _place_goal(model: mujoco.MjModel, data: mujoco.MjData, goal: NDArray[np.floating]) -> None:
    """Move the sites that mark the goal; a hand's target is a body, which stands at its goal already.

    Positions are forwarded, or the first frame would not show it.
    """
    mujoco.mj_forward(model, data)
    for index, site in enumerate(goal_sites(model)):
        body = int(model.site_bodyid[site])
        marked = goal[3 * index : 3 * index + 3]
        model.site_pos[site] = data.xmat[body].reshape(3, 3).T @ (marked - data.xpos[body])
    mujoco.mj_forward(model, data)

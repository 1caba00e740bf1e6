"""Where the eye is: one camera for the browser, the pictures and their comparison."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from sldr_core.config import Phase, TaskSpec


@dataclass(frozen=True)
class Camera:
    """Look at a point from a distance and two angles, as MuJoCo's free camera does."""

    look_at: tuple[float, float, float]
    """The point in the middle of the picture [m]."""
    distance: float
    """From the eye to that point [m]."""
    azimuth: float
    """Direction of the look around z, from x [degrees]."""
    elevation: float
    """Direction of the look above the horizon [degrees]."""
    field_of_view: float = 35.0
    """Vertical opening [degrees]."""

    @property
    def position(self) -> NDArray[np.float64]:
        """Where the eye is [m], `[3]`."""
        azimuth, elevation = np.radians([self.azimuth, self.elevation])
        forward = [np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)]
        return np.asarray(self.look_at) - self.distance * np.asarray(forward)

    def as_mujoco(self) -> mujoco.MjvCamera:
        """Return the same camera for MuJoCo's renderer; the opening is the model's `vis.global_.fovy`."""
        camera = mujoco.MjvCamera()
        camera.type = mujoco.mjtCamera.mjCAMERA_FREE
        camera.lookat[:] = self.look_at
        camera.distance, camera.azimuth, camera.elevation = self.distance, self.azimuth, self.elevation
        return camera


FETCH_ROBOT = Camera(look_at=(1.2, 0.75, 0.55), distance=2.1, azimuth=138.0, elevation=-24.0)
"""Table, gripper and arm, from the corner across the robot."""

FETCH_TABLE = Camera(look_at=(1.3, 0.75, 0.42), distance=1.4, azimuth=138.0, elevation=-30.0)
"""The table alone."""

HAND = Camera(look_at=(1.04, 0.93, 0.16), distance=0.62, azimuth=70.0, elevation=-42.0)
"""The palm with its object, and the target beside it, from above the fingertips."""


_CAMERAS: dict[tuple[str, Phase], Camera] = {
    ("fetch", "manipulation"): FETCH_ROBOT,
    ("fetch", "locomotion"): FETCH_TABLE,
    ("stack", "manipulation"): FETCH_ROBOT,
    ("stack", "locomotion"): FETCH_TABLE,
    ("tuple", "manipulation"): FETCH_ROBOT,
    ("tuple", "locomotion"): FETCH_TABLE,
    ("hand", "manipulation"): HAND,
    ("hand", "locomotion"): HAND,
}
"""The camera of each family and phase."""


def find_camera(task: TaskSpec, phase: Phase) -> Camera:
    """Return the camera that frames the workspace of a task."""
    return _CAMERAS[task.family, phase]

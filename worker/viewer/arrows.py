"""Actions of objects as arrows: where they push, and about which axis they turn.

An action of an object is, for each body it moves, a change of position (3) and a raw change of quaternion (4).
`U` action, `M` bodies that it moves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from sldr_core.envs.rotations import multiply_quaternions

WANTED_RGB = (0, 114, 178)
"""u, what the object wanted: blue."""

INDUCED_RGB = (230, 115, 0)
"""w, what the robot made it do: orange, told from blue by every kind of colour vision."""

POSE_CHANGE = 7
"""Entries of an action for each body."""

QUATERNION_SPEED = 0.05
"""Change of a quaternion's entry at full action."""

FULL_TURN = 2.0 * QUATERNION_SPEED
"""Turn at a full action of one entry, drawn as long as a full push [rad]."""

SHORTEST = 1e-4
"""Shorter arrows are not drawn [m]."""


@dataclass(frozen=True)
class ArrowSize:
    """Say how large arrows are drawn."""

    reach: float
    """Length of a full push along one axis [m]."""

    @property
    def shaft(self) -> float:
        """Radius of the shaft [m]."""
        return 0.035 * self.reach


TABLE_ARROWS = ArrowSize(0.16)
HAND_ARROWS = ArrowSize(0.06)


def push_and_turn(
    action: NDArray[np.floating], quaternions: NDArray[np.floating]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return how an action pushes and turns, in shares of a full push and a full turn, `[M, 3]` each.

    Args:
        action: `[U]`.
        quaternions: of the bodies that it moves, w first, `[M, 4]`. The turn is about the axis in the world.
    """
    changes = np.asarray(action, dtype=np.float64).reshape(-1, POSE_CHANGE)
    before = np.asarray(quaternions, dtype=np.float64)
    after = before + QUATERNION_SPEED * changes[:, 3:]
    after /= np.linalg.norm(after, axis=1, keepdims=True)
    between = np.stack(
        [multiply_quaternions(new, old * (1, -1, -1, -1)) for new, old in zip(after, before, strict=True)]
    )
    between *= np.where(between[:, :1] < 0.0, -1.0, 1.0)
    return changes[:, :3], 2.0 * between[:, 1:] / FULL_TURN


class ActionArrows:
    """Draw the actions of one part in one colour: thick arrows push, thin ones are axes to turn about."""

    def __init__(self, server: viser.ViserServer, path: str, colour: tuple[int, int, int], size: ArrowSize) -> None:
        self._size = size
        self._pushes = self._add(server, f"{path}/push", colour, size.shaft)
        self._turns = self._add(server, f"{path}/turn", colour, 0.4 * size.shaft)

    def show(
        self,
        action: NDArray[np.floating],
        positions: NDArray[np.floating],
        quaternions: NDArray[np.floating],
        turns: bool = True,
    ) -> None:
        """Draw an action `[U]` at bodies `[M, 3]` with quaternions `[M, 4]`."""
        push, turn = push_and_turn(action, quaternions)
        self._draw(self._pushes, positions, push)
        self._draw(self._turns, positions, turn if turns else np.zeros_like(turn))

    def hide(self) -> None:
        """Draw nothing."""
        self._pushes.visible = self._turns.visible = False

    def _add(
        self, server: viser.ViserServer, path: str, colour: tuple[int, int, int], shaft: float
    ) -> viser.ArrowsHandle:
        return server.scene.add_arrows(
            path,
            np.array([[[0.0, 0.0, 0.0], [0.0, 0.0, 1e-3]]]),
            colour,
            shaft_radius=shaft,
            head_radius=2.4 * shaft,
            head_length=4.0 * shaft,
            visible=False,
        )

    def _draw(self, node: viser.ArrowsHandle, positions: NDArray[np.floating], shares: NDArray[np.floating]) -> None:
        ends = positions + self._size.reach * shares
        long_enough = np.linalg.norm(ends - positions, axis=1) > SHORTEST
        node.visible = bool(long_enough.any())
        if node.visible:
            node.points = np.stack([positions, ends], axis=1)[long_enough].astype(np.float32)

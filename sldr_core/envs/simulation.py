"""N simulations of one scene, stepped together on threads, read and written through live arrays.

`N` simulations. Arrays named here are views: they change with every call that steps, resets or forwards.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import mjbatch
import mujoco
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ids = NDArray[np.int64]

UNSTABLE = [
    int(warning)
    for warning in (
        mujoco.mjtWarning.mjWARN_BADQPOS,
        mujoco.mjtWarning.mjWARN_BADQVEL,
        mujoco.mjtWarning.mjWARN_BADQACC,
    )
]
"""Warnings after which MuJoCo has put a simulation back to where its scene begins."""


class Simulation:
    """Hold a batch of simulations and the arrays that the environments need."""

    def __init__(self, model: mujoco.MjModel, num_envs: int, threads: int) -> None:
        self.model = model
        self.num_envs = num_envs
        self.batch = mjbatch.Batch(model, num_envs, min(threads, num_envs))
        self.state: Array = self.batch.bind("state")
        self.qpos: Array = self.batch.bind("qpos")
        self.qvel: Array = self.batch.bind("qvel")
        self.ctrl: Array = self.batch.bind("ctrl")
        self.mocap_pos: Array = self.batch.bind("mocap_pos")
        self.mocap_quat: Array = self.batch.bind("mocap_quat")
        self.body_pos: Array = self.batch.bind("xpos")
        self.body_quat: Array = self.batch.bind("xquat")
        self.site_pos: Array = self.batch.bind("site_xpos")
        self.site_mat: Array = self.batch.bind("site_xmat")
        self._motion_axes: Array = self.batch.bind("cdof")
        self._subtree_com: Array = self.batch.bind("subtree_com")
        self._warnings: NDArray[np.int32] = self.batch.bind("warning")
        written = (self.qpos, self.qvel, self.ctrl, self.mocap_pos, self.mocap_quat)
        derived = (self.body_pos, self.body_quat, self.site_pos, self.site_mat, self._motion_axes, self._subtree_com)
        self._views: tuple[Array, ...] = (*written, *derived)
        self.batch.reset()

    def step(self, substeps: int, ids: Ids | None = None) -> None:
        """Advance simulations `ids` (all if None) by `substeps` physics steps."""
        self.batch.step(ids, nstep=substeps)

    def forward(self) -> None:
        """Bring everything derived up to date with positions and velocities."""
        self.batch.forward()

    def forward_motion(self) -> None:
        """Bring what the arrays here show up to date with positions and velocities, but contacts and forces not.

        Those are three quarters of the work, and the next step works them out anew from the same numbers.
        """
        flags = self._disabled_parts
        usual = flags.copy()
        flags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
        try:
            self.batch.forward()
        finally:
            flags[:] = usual

    def reset(self, ids: Ids, qpos: Array, qvel: Array) -> None:
        """Start simulations `ids` afresh from `qpos` `[len(ids), nq]` and `qvel` `[len(ids), nv]`."""
        self.batch.reset(ids)
        self.qpos[ids] = qpos
        self.qvel[ids] = qvel
        self.batch.forward(ids)

    def unstable(self) -> NDArray[np.bool_]:
        """Tell in which simulations numbers grew beyond all bounds since their last reset, `[N]`.

        MuJoCo puts such a simulation back to where its scene begins, in the middle of whatever was going on.
        """
        return np.any(self._warnings[:, UNSTABLE, 1], axis=1)

    def snapshot(self) -> Array:
        """Return everything that can be read or will be stepped on from, one row for each simulation, `[N, K]`.

        Derived values are part of it: after a step they lag one substep behind positions and velocities, and the next
        step starts from what they say, so they cannot be worked out anew.
        """
        return np.concatenate([part.reshape(self.num_envs, -1) for part in (self.state, *self._views)], axis=1)

    def restore(self, snapshot: Array) -> None:
        """Bring every simulation to the state that `snapshot` returned, to the last bit.

        Raises:
            ValueError: it is a snapshot of another scene, or of another number of simulations.
        """
        sizes = [part[0].size for part in (self.state, *self._views)]
        if snapshot.shape != (self.num_envs, sum(sizes)):
            raise ValueError(f"expected a snapshot of shape {(self.num_envs, sum(sizes))}, got {snapshot.shape}")
        state, *views = np.split(snapshot, np.cumsum(sizes)[:-1], axis=1)
        # Forwarding ends what was pending, but changes the state itself, so that is written twice.
        self.state[:] = state
        self.forward()
        self.state[:] = state
        for view, values in zip(self._views, views, strict=True):
            view[:] = values.reshape(view.shape)

    def has_body(self, name: str) -> bool:
        """Tell whether the scene has a body of this name."""
        return mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_BODY, name) >= 0

    def has_joint(self, name: str) -> bool:
        """Tell whether the scene has a joint of this name."""
        return mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_JOINT, name) >= 0

    def site(self, name: str) -> Site:
        """Resolve a site once, with the joints that move it."""
        site = self.model.site(name).id
        body = int(self.model.site_bodyid[site])
        return Site(self, site, int(self.model.body_rootid[body]), _dofs_above(self.model, body))

    def mocap(self, mocap_body: str, welded_body: str) -> Mocap:
        """Resolve a mocap body and the body that is welded to it once."""
        mocap_id = int(self.model.body_mocapid[self.model.body(mocap_body).id])
        return Mocap(self, mocap_id, self.model.body(welded_body).id)

    @cached_property
    def _disabled_parts(self) -> NDArray[np.int32]:
        """What each simulation's physics leaves out, `[N]`, live."""
        return self.batch.expand("disableflags")

    def velocity_parts(self, dofs: Sequence[int] | NDArray[np.int64], root: int) -> tuple[Array, Array, Array]:
        """Return motion axes `[N, dofs, 6]`, joint velocities `[N, dofs]` and the root's centre of mass `[N, 3]`."""
        return self._motion_axes[:, dofs], self.qvel[:, dofs], self._subtree_com[:, root]


@dataclass(frozen=True)
class Site:
    """A named point of the scene."""

    simulation: Simulation
    index: int
    root: int
    dofs: NDArray[np.int64]

    @property
    def pos(self) -> Array:
        """Positions [m], `[N, 3]`, a view."""
        return self.simulation.site_pos[:, self.index]

    def velocity(self) -> tuple[Array, Array]:
        """Return linear [m/s] and angular [rad/s] velocity, each `[N, 3]`.

        It is the site's Jacobian times the joint velocities, as in the reference: not MuJoCo's own `cvel`, which
        lags one substep behind when the scene was stepped last.
        """
        axes, speeds, com = self.simulation.velocity_parts(self.dofs, self.root)
        twist = np.einsum("nds,nd->ns", axes, speeds)
        angular, linear = twist[:, :3], twist[:, 3:]
        return linear + _cross(angular, self.pos - com), angular


@dataclass(frozen=True)
class Mocap:
    """A mocap body that pulls the body welded to it."""

    simulation: Simulation
    mocap_id: int
    body_id: int

    def pull(self, position_change: NDArray[np.floating], quaternion_change: NDArray[np.floating]) -> None:
        """Put the mocap where its body is now, plus a change of position [m] and a raw one of the quaternion."""
        simulation = self.simulation
        simulation.mocap_pos[:, self.mocap_id] = simulation.body_pos[:, self.body_id] + position_change
        simulation.mocap_quat[:, self.mocap_id] = simulation.body_quat[:, self.body_id] + quaternion_change


def _cross(a: Array, b: Array) -> Array:
    """Return the cross products of `[N, 3]` and `[N, 3]` as `numpy.cross` does, to the last bit, but sooner."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    product = np.empty_like(a)
    product[:, 0] = ay * bz - az * by
    product[:, 1] = az * bx - ax * bz
    product[:, 2] = ax * by - ay * bx
    return product


def _dofs_above(model: mujoco.MjModel, body: int) -> NDArray[np.int64]:
    """Return the degrees of freedom that move a body, from the world down."""
    dofs: list[int] = []
    while body > 0:
        first = int(model.body_dofadr[body])
        if first >= 0:
            dofs = [*range(first, first + int(model.body_dofnum[body])), *dofs]
        body = int(model.body_parentid[body])
    return np.asarray(dofs, dtype=np.int64)

"""Batched environments: N simulations of one task and phase, stepped together.

    envs = make_envs("FetchPush", num_envs=38, seed=0, threads=2)
    now = envs.reset()
    now = envs.step(actions)

`N` simulations, `D` observation, `G` goal, `A` action of the one who acts.
"""

from __future__ import annotations

from sldr_core.config import PHASES, Phase, find_task
from sldr_core.envs.envs import Envs, Observation
from sldr_core.envs.fetch import (
    FetchStarts,
    FingerHold,
    GripperActuation,
    ObjectActuation,
    ObjectObserver,
    RobotObserver,
)
from sldr_core.envs.scenes.fetch import Robot, build_fetch, settle_fetch
from sldr_core.envs.simulation import Simulation
from sldr_core.errors import UnknownName

__all__ = ["Envs", "Observation", "make_envs"]


def make_envs(
    task: str,
    phase: Phase = "manipulation",
    num_envs: int = 1,
    seed: int = 0,
    threads: int = 1,
    robot: Robot = "absent",
) -> Envs:
    """Build the environments of a task's phase.

    Args:
        task: name of a task.
        phase: who acts, the object (`locomotion`) or the robot (`manipulation`).
        num_envs: simulations, `N`.
        seed: simulation `i` draws from its own generator of (`seed`, `i`).
        threads: threads that step the simulations; results do not depend on it.
        robot: what the robot does in locomotion; of no meaning in manipulation.

    Raises:
        UnknownName: no such task or phase.
    """
    spec = find_task(task)
    if phase not in PHASES:
        raise UnknownName("phase", phase, PHASES)
    simulation = Simulation(build_fetch(spec, phase, robot), num_envs, threads)
    robot_acts = phase == "manipulation" or robot != "absent"
    gripper = GripperActuation(simulation, spec.gripper_blocked) if robot_acts else None
    return Envs(
        spec=spec,
        phase=phase,
        simulation=simulation,
        actor=ObjectActuation(simulation)
        if phase == "locomotion"
        else GripperActuation(simulation, spec.gripper_blocked),
        bystander=gripper if phase == "locomotion" else None,
        bystander_moves=robot == "random",
        observer=RobotObserver(simulation) if phase == "manipulation" else ObjectObserver(simulation),
        starts=FetchStarts(spec, settle_fetch(spec), simulation),
        hold=FingerHold(simulation) if spec.gripper_blocked else None,
        seed=seed,
    )

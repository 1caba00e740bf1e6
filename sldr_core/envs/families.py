"""How each family's scene, starts and parts go together."""

from __future__ import annotations

from dataclasses import dataclass

from sldr_core.config import FetchScene, HandScene, Phase, Robot, StackScene, TaskSpec, TupleScene
from sldr_core.envs.fetch import fetch_parts, robot_stays
from sldr_core.envs.hand import HandActuation, HandObjectObserver, HandRobotObserver, HandStarts, TargetMarker
from sldr_core.envs.parts import EnvParts, ObjectActuation
from sldr_core.envs.scenes.fetch import build_fetch, settle_fetch
from sldr_core.envs.scenes.hand import OBJECT, build_hand, without_welds
from sldr_core.envs.scenes.stack import build_stack, settle_stack
from sldr_core.envs.scenes.tuple import BLOCK_SIDE, build_tuple, settle_tuple
from sldr_core.envs.scenes.welds import object_mocap
from sldr_core.envs.simulation import Simulation
from sldr_core.envs.table_starts import FetchStarts, StackStarts, TupleStarts


@dataclass(frozen=True)
class EnvOrder:
    """Say which environment is wanted, as `make_envs` was asked."""

    spec: TaskSpec
    phase: Phase
    robot: Robot
    num_envs: int
    threads: int
    testing: bool

    @property
    def acts(self) -> bool:
        """Whether the object acts."""
        return self.phase == "locomotion"


def build_fetch_env(order: EnvOrder) -> EnvParts:
    """Build one object on a table."""
    spec, scene = order.spec, order.spec.scene
    assert isinstance(scene, FetchScene)
    acted = (0,) if order.acts else ()
    model = build_fetch(scene, acted, robot_stays(order.phase, order.robot), spec.weld_torque_scale)
    simulation = Simulation(model, order.num_envs, order.threads)
    starts = FetchStarts(scene, settle_fetch(scene), model)
    return fetch_parts(scene, 1, acted, order.phase, simulation, starts)


def build_stack_env(order: EnvOrder) -> EnvParts:
    """Build blocks on a table with a wall; its objects learn elsewhere, so only the robot acts."""
    scene = order.spec.scene
    assert isinstance(scene, StackScene)
    model = build_stack(scene)
    simulation = Simulation(model, order.num_envs, order.threads)
    starts = StackStarts(scene, settle_stack(scene), model, 1.0 if order.testing else scene.stack_probability)
    return fetch_parts(scene, scene.objects, (), order.phase, simulation, starts)


def build_tuple_env(order: EnvOrder) -> EnvParts:
    """Build a chain of blocks on a table, which moves itself by its two ends."""
    spec, scene = order.spec, order.spec.scene
    assert isinstance(scene, TupleScene)
    acted = (0, scene.objects - 1) if order.acts else ()
    model = build_tuple(scene, acted, robot_stays(order.phase, order.robot), spec.weld_torque_scale)
    simulation = Simulation(model, order.num_envs, order.threads)
    starts = TupleStarts(scene, settle_tuple(scene), model, BLOCK_SIDE)
    return fetch_parts(scene, scene.objects, acted, order.phase, simulation, starts)


def build_hand_env(order: EnvOrder) -> EnvParts:
    """Build an object in the hand, which stays whoever acts: the object lies on it."""
    spec, scene = order.spec, order.spec.scene
    assert isinstance(scene, HandScene)
    model = build_hand(scene, order.acts, spec.weld_torque_scale)
    simulation = Simulation(model, order.num_envs, order.threads)
    settling = Simulation(without_welds(model), order.num_envs, order.threads)
    hand = HandActuation(simulation)
    return EnvParts(
        simulation=simulation,
        actor=ObjectActuation([simulation.mocap(object_mocap(0), OBJECT)]) if order.acts else hand,
        bystander=hand if order.acts else None,
        observer=HandObjectObserver(simulation) if order.acts else HandRobotObserver(simulation),
        starts=HandStarts(scene, settling),
        hold=None,
        marker=TargetMarker(scene, simulation),
    )

"""Batched environments: N simulations of one task and phase, stepped together.

    envs = make_envs("FetchPush", num_envs=38, seed=0, threads=2)
    now = envs.reset()
    now = envs.step(actions)

`N` simulations, `D` observation, `G` goal, `A` action of the one who acts.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import get_args

from sldr_core.config import PHASES, Phase, RewardKind, Robot, TaskSpec, Variant, explain_misfit, find_task
from sldr_core.envs.contacts import TouchSense
from sldr_core.envs.envs import Envs, Observation
from sldr_core.envs.families import EnvOrder, build_fetch_env, build_hand_env, build_stack_env, build_tuple_env
from sldr_core.envs.parts import EnvParts, Start
from sldr_core.envs.rewards import REWARDS
from sldr_core.errors import InvalidConfig, UnknownName

__all__ = ["Envs", "Observation", "Start", "TouchSense", "make_envs"]

FAMILIES: dict[str, Callable[[EnvOrder], EnvParts]] = {
    "fetch": build_fetch_env,
    "stack": build_stack_env,
    "tuple": build_tuple_env,
    "hand": build_hand_env,
}
"""How the environment of each family is put together."""


def make_envs(
    task: str,
    phase: Phase = "manipulation",
    num_envs: int = 1,
    seed: int = 0,
    threads: int = 1,
    robot: Robot = "auto",
    testing: bool = False,
    variant: Variant = "ours",
    *,
    reward: RewardKind = "sparse",
) -> Envs:
    """Build the environments of a task's phase.

    Args:
        task: name of a task.
        phase: who acts, the object (`locomotion`) or the robot (`manipulation`).
        num_envs: simulations, `N`.
        seed: simulation `i` draws from its own generator of (`seed`, `i`).
        threads: threads that step the simulations; results do not depend on it.
        robot: what the robot does in locomotion; of no meaning in manipulation.
        testing: whether goals are drawn as in tests, where a task has such a difference.
        variant: whose numbers the task has.
        reward: the reward of a step; success is the same with both.

    Raises:
        UnknownName: no such task, phase, robot, variant or reward.
        InvalidConfig: the task has no such phase, or no such robot; or nothing would be simulated.
    """
    choices = {
        "variant": (variant, get_args(Variant)),
        "phase": (phase, PHASES),
        "robot": (robot, get_args(Robot)),
        "reward": (reward, REWARDS),
    }
    for kind, (name, known) in choices.items():
        if name not in known:
            raise UnknownName(kind, name, known)
    too_low = {name: "has to be 1 or more." for name, n in (("num_envs", num_envs), ("threads", threads)) if n < 1}
    if too_low:
        raise InvalidConfig(too_low)
    spec = find_task(task, variant)
    _check(spec, phase, robot)
    parts = FAMILIES[spec.family](EnvOrder(spec, phase, robot, num_envs, threads, testing))
    return Envs(spec=spec, phase=phase, parts=parts, bystander_moves=robot == "random", reward=reward, seed=seed)


def _check(spec: TaskSpec, phase: Phase, robot: Robot) -> None:
    misfit = explain_misfit(spec, phase)
    if misfit is not None:
        raise InvalidConfig({"task": misfit})
    if phase == "locomotion" and spec.family == "hand" and robot == "absent":
        raise InvalidConfig({"robot": "the object lies in the hand; choose 'auto', 'still' or 'random'."})

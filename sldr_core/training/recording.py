"""Recording a test's first episodes with what the training's streams and critics say of every transition.

Nothing of the training is changed: no generator is drawn from and nothing is learnt.
`E` episodes, `T` steps, `B` = E T transitions, `S` streams, `P` parts, `U` object action.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import torch
from torch import Tensor

from sldr_core.config import config_hash, config_to_dict
from sldr_core.envs import Envs, TouchSense
from sldr_core.episodes import Course, Origin, RecordedEpisode, RecordedTest
from sldr_core.nets.transitions import Transitions
from sldr_core.records import Floats
from sldr_core.streams import ObjectActions
from sldr_core.training.build import Parts
from sldr_core.training.resimulation import first_differences, make_resimulation


class EpisodeRecording:
    """Turn the courses of a training's test episodes into records."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._resimulation: Envs | None = None
        self._objects = TouchSense(parts.test_envs.model).objects

    def record(self, courses: Sequence[Course], epoch: int, env_steps: int) -> RecordedTest:
        """Return the record of a test.

        Args:
            courses: its first episodes, at least one; as many in every test.
            epoch: epochs trained when it was held.
            env_steps: control steps of training episodes by then.
        """
        parts = self._parts
        batch = transitions_of(parts, courses)
        rewards = torch.stack([stream.reward(batch) for stream in parts.streams], dim=1)
        values = parts.agent.values(batch.obs, batch.goal, batch.action).T
        acted = [actions for stream in parts.streams if (actions := stream.object_actions(batch)) is not None]
        said = {
            "reward": _by_episode(rewards, len(courses)),
            "value": _by_episode(values, len(courses)),
            "wanted": _by_episode(_stack([actions.wanted for actions in acted], len(batch.obs)), len(courses)),
            "induced": _by_episode(_stack([actions.induced for actions in acted], len(batch.obs)), len(courses)),
        }
        return RecordedTest(
            self._origin(acted, epoch, env_steps),
            tuple(
                RecordedEpisode(
                    **vars(course),
                    resimulates=difference is None,
                    **{name: array[at] for name, array in said.items()},
                )
                for at, (course, difference) in enumerate(zip(courses, self._differences(courses), strict=True))
            ),
        )

    def _origin(self, acted: Sequence[ObjectActions], epoch: int, env_steps: int) -> Origin:
        config = self._parts.config
        return Origin(
            config=config_to_dict(config),
            config_hash=config_hash(config),
            epoch=epoch,
            env_steps=env_steps,
            streams=tuple(stream.name for stream in self._parts.streams),
            parts=tuple(actions.part for actions in acted),
            objects=self._objects,
        )

    def _differences(self, courses: Sequence[Course]) -> list[int | None]:
        if self._resimulation is None:
            parts = self._parts
            self._resimulation = make_resimulation(parts.config, len(courses), parts.compute.threads)
        return first_differences(self._resimulation, courses)


def transitions_of(parts: Parts, courses: Sequence[Course]) -> Transitions:
    """Return every transition of some episodes under its original goal, as the training would draw it."""
    obs = np.stack([course.obs for course in courses])
    achieved = np.stack([course.achieved for course in courses])
    action = np.stack([course.action for course in courses])
    length = action.shape[1]
    goal = np.stack([course.goal.astype(np.float32) for course in courses])[:, None].repeat(length, axis=1)
    extra: Mapping[str, Floats] = {
        name: values for stream in parts.streams for name, values in stream.annotate(obs).items()
    }

    def on_device(array: Floats) -> Tensor:
        """Flatten `[E, T, ...]` to `[B, ...]`."""
        return torch.from_numpy(np.ascontiguousarray(array.reshape(-1, *array.shape[2:]))).to(parts.compute.device)

    return Transitions(
        obs=on_device(obs[:, :-1]),
        next_obs=on_device(obs[:, 1:]),
        goal=on_device(goal),
        action=on_device(action),
        reward=on_device(parts.envs.reward(achieved[:, 1:], goal)),
        extra={name: on_device(values) for name, values in extra.items()},
    )


def _stack(columns: Sequence[Tensor], transitions: int) -> Tensor:
    """Return actions `[B, P, U]` of `P` times `[B, U]`."""
    return torch.stack(list(columns), dim=1) if columns else torch.zeros((transitions, 0, 0))


def _by_episode(values: Tensor, episodes: int) -> Floats:
    """Return `[E, T, ...]` of `[B, ...]`."""
    return values.float().cpu().numpy().reshape(episodes, len(values) // episodes, *values.shape[1:])

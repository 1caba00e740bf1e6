"""The settings of one training: frozen, documented, checked; every default stands here and nowhere else."""

from __future__ import annotations

import hashlib
import json
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, TypeAdapter, ValidationError, model_validator
from pydantic.dataclasses import dataclass

from sldr_core.config.method_settings import CurriculumConfig, RndConfig, SldrConfig
from sldr_core.config.methods import METHODS, MethodSpec, find_method
from sldr_core.config.numbers import Count, Positive, Rate, Return, Share, Weight
from sldr_core.config.tasks import LOCOMOTION_TASKS, TASKS, Phase, TaskSpec, Variant, explain_misfit, find_task
from sldr_core.errors import InvalidConfig, UnknownName

_FROZEN = ConfigDict(extra="forbid", use_attribute_docstrings=True, allow_inf_nan=False)

Robot = Literal["auto", "absent", "still", "random"]
"""What the robot does while the object learns."""


@dataclass(frozen=True, config=_FROZEN)
class LoopConfig:
    """How much is collected, learnt and tested (paper §6.1)."""

    epochs: Positive = 50
    """Epochs of training; each ends with a test."""
    cycles_per_epoch: Positive = 50
    """Cycles of one epoch; each collects episodes and learns."""
    collecting: Literal["before", "beside"] = "before"
    """`before`: a cycle's updates see its episodes; `beside`: both happen at once, and updates see all earlier ones."""
    episodes_per_cycle: Positive = 38
    """Episodes collected in parallel in each cycle, one per simulation."""
    updates_per_cycle: Positive = 40
    """Gradient updates of critics and actor in each cycle."""
    updates_per_sync: Positive = 40
    """Updates between two soft updates of the target networks."""
    batch_size: Positive = 4864
    """Transitions in each update."""
    warmup_cycles: Count = 1
    """Cycles of uniformly random actions collected before the first update."""
    test_episodes: Positive = 380
    """Episodes of each test, without noise on the actions."""
    recorded_episodes: Annotated[int, Field(ge=0, le=64)] = 6
    """The first episodes of each test that are kept to be looked at (0: none); what is learnt does not depend on it."""
    stop_at_success: Share = 1.0
    """End the training early once this test success is held for `stop_after_tests` tests in a row."""
    stop_after_tests: Count = 0
    """Tests in a row at `stop_at_success` that end the training early (0: never end early)."""


@dataclass(frozen=True, config=_FROZEN)
class AgentConfig:
    """The DDPG learner: networks, optimiser, targets."""

    hidden_sizes: Annotated[tuple[Positive, ...], Field(min_length=1)] = (256, 256, 256)
    """Units of the hidden layers of every network."""
    learning_rate: Rate = 1e-3
    """Step size of Adam for every network."""
    gamma: Rate = 0.98
    """Discount of future rewards."""
    lowest_return: Return = 0.0
    """Targets of the task's critic are clipped to this and 0 (0: to -1 / (1 - gamma), the least possible return)."""
    lowest_auxiliary_return: Return = 0.0
    """The same for the critics of all other rewards (0: as the task's)."""
    target_rate: Annotated[float, Field(gt=0.0, le=1.0)] = 0.05
    """Share of the online weights that enters the target networks at each sync (1 - polyak)."""
    average_rate: Annotated[float, Field(gt=0.0, le=1.0)] = 1.0
    """Share of the actor's weights that enters its average at each update; tests and kept policies act by the average
    (1: by the actor as it is)."""
    action_l2: Weight = 1.0
    """Weight of the mean squared action in the actor's loss."""


@dataclass(frozen=True, config=_FROZEN)
class ExplorationConfig:
    """The noise on actions while episodes are collected."""

    random_action_probability: Share = 0.3
    """Probability of a uniformly random action at each step."""
    noise_std: Weight = 0.2
    """Standard deviation of the Gaussian noise on the other actions."""


@dataclass(frozen=True, config=_FROZEN)
class ReplayConfig:
    """What is remembered, and how it is drawn."""

    capacity: Positive = 1_000_000
    """Transitions held; whole episodes, the oldest replaced first."""
    relabel_probability: Share = 0.8
    """Share of sampled transitions whose goal is replaced by one achieved later in the episode (`make_config` and every
    launch: as the method has it)."""
    still_weight: Annotated[float, Field(gt=0.0, le=1.0)] = 1.0
    """How often an episode in which nothing moved is drawn, against one in which something did (1: alike)."""
    met_weight: Annotated[float, Field(gt=0.0, le=1.0)] = 1.0
    """How often a relabelled transition that begins at its goal is drawn, against one that does not (1: alike)."""


@dataclass(frozen=True, config=_FROZEN)
class SceneConfig:
    """Whose numbers the task has, and what stands in its scene."""

    variant: Variant = "ours"
    """`ours`: the task as the paper describes it; `original`: with the numbers of the authors' code."""
    locomotion_robot: Robot = "auto"
    """What the robot does while the object learns: removed, kept still, or acting at random.

    `auto` removes it, but keeps it still where the object lies on it.
    """


@dataclass(frozen=True, config=_FROZEN)
class ComputeConfig:
    """Where and how precisely the numbers are computed."""

    device: Literal["auto", "cpu", "cuda"] = "auto"
    """`auto` takes a GPU when there is one."""
    precision: Literal["float32", "bfloat16"] = "float32"
    """`bfloat16` runs the learner under autocast: faster where the processor has the instructions, slower elsewhere."""
    threads: Count = 0
    """Threads for simulation and learner (0: one per available core, shared out between a worker's slots)."""


@dataclass(frozen=True, config=_FROZEN)
class TrainConfig:
    """Everything that decides what one training computes. Equal configs give equal metrics."""

    task: str = "FetchPush"
    """The task to learn."""
    phase: Phase = "manipulation"
    """Who acts: the object on its own (locomotion) or the robot (manipulation)."""
    method: str = "her-sldr"
    """Which rewards and which sampler the agent learns with; its share of replaced goals is a setting of its own."""
    seed: Annotated[int, Field(ge=0, lt=2**31)] = 0
    """Seed of every random number of the training."""
    loop: LoopConfig = Field(default_factory=LoopConfig)
    """How much is collected, learnt and tested."""
    agent: AgentConfig = Field(default_factory=AgentConfig)
    """The DDPG learner."""
    exploration: ExplorationConfig = Field(default_factory=ExplorationConfig)
    """The noise on actions while episodes are collected."""
    replay: ReplayConfig = Field(default_factory=ReplayConfig)
    """What is remembered, and how it is drawn."""
    sldr: SldrConfig = Field(default_factory=SldrConfig)
    """The reward for moving the object as it would move itself."""
    rnd: RndConfig = Field(default_factory=RndConfig)
    """The reward for states that were seldom seen."""
    curriculum: CurriculumConfig = Field(default_factory=CurriculumConfig)
    """Which of more candidates an update learns from."""
    scene: SceneConfig = Field(default_factory=SceneConfig)
    """What stands in the simulated scene."""
    compute: ComputeConfig = Field(default_factory=ComputeConfig)
    """Where and how precisely the numbers are computed."""

    @model_validator(mode="after")
    def _check_names_and_sizes(self) -> TrainConfig:
        self._check_task()
        if self.method not in METHODS:
            raise ValueError(f"method: {UnknownName('method', self.method, METHODS)}")
        if self.phase not in self.method_spec.phases:
            raise ValueError("method: a locomotion run learns from the sparse reward alone; use 'her'.")
        if self.method_spec.sampler == "curriculum":
            self._check_curriculum()
        if self.loop.collecting == "beside" and self.loop.warmup_cycles == 0:
            raise ValueError(
                "loop.warmup_cycles: the first updates would have nothing to learn from; choose 1 or more."
            )
        cycle = self.loop.episodes_per_cycle * self.task_spec.episode_length
        if self.replay.capacity < 2 * cycle:
            raise ValueError(
                f"replay.capacity: {self.replay.capacity} transitions cannot hold two cycles of {cycle}; raise it."
            )
        return self

    def _check_task(self) -> None:
        if self.task not in TASKS | LOCOMOTION_TASKS:
            raise ValueError(f"task: {UnknownName('task', self.task, TASKS)}")
        misfit = explain_misfit(self.task_spec, self.phase)
        if misfit is not None:
            raise ValueError(f"task: {misfit}")
        if self.task_spec.family == "hand" and self.scene.locomotion_robot == "absent":
            raise ValueError("scene.locomotion_robot: the object lies in the hand; choose 'auto', 'still' or 'random'.")

    def _check_curriculum(self) -> None:
        given, batch = self.curriculum, self.loop.batch_size
        if batch % given.group_size != 0:
            raise ValueError(
                f"loop.batch_size: {batch} is no whole number of groups of {given.group_size}; choose a multiple, "
                "or change curriculum.group_size."
            )
        if given.kept + given.examined - 1 > given.candidates:
            raise ValueError(
                f"curriculum.kept: the last of {given.kept} picks could not compare {given.examined} of what is left "
                f"of {given.candidates} candidates; lower it, or raise curriculum.candidates."
            )

    @property
    def task_spec(self) -> TaskSpec:
        """The task's numbers."""
        return find_task(self.task, self.scene.variant)

    @property
    def method_spec(self) -> MethodSpec:
        """The method's parts."""
        return find_method(self.method)

    @property
    def needs_locomotion(self) -> bool:
        """Tell whether this training takes its reward from a locomotion model."""
        return self.phase == "manipulation" and self.method_spec.needs_locomotion

    @property
    def total_cycles(self) -> int:
        """Cycles of the whole training."""
        return self.loop.epochs * self.loop.cycles_per_epoch


_ADAPTER: TypeAdapter[TrainConfig] = TypeAdapter(TrainConfig)


def config_from_dict(values: dict[str, Any]) -> TrainConfig:
    """Build a config from plain values, naming every setting that cannot work.

    Raises:
        InvalidConfig: at least one setting is unknown, of the wrong type or out of range.
    """
    try:
        return _ADAPTER.validate_python(values)
    except ValidationError as err:
        raise InvalidConfig(_problems(err)) from err


def config_to_dict(config: TrainConfig) -> dict[str, Any]:
    """Return a config as plain JSON values."""
    return _ADAPTER.dump_python(config, mode="json")


def config_schema() -> dict[str, Any]:
    """Return the JSON schema of a config, with a description and default of every setting."""
    return _ADAPTER.json_schema()


def config_hash(config: TrainConfig) -> str:
    """Return 16 hex digits that are equal for configs that compute the same training."""
    return _digest(config_to_dict(config))


def settings_hash(config: TrainConfig) -> str:
    """Return 16 hex digits that are equal for configs that differ in nothing but the seed."""
    return _digest({name: value for name, value in config_to_dict(config).items() if name != "seed"})


def _digest(values: dict[str, Any]) -> str:
    canonical = json.dumps(values, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(canonical.encode()).hexdigest()[:16]


def _problems(err: ValidationError) -> dict[str, str]:
    problems: dict[str, str] = {}
    for error in err.errors(include_url=False):
        setting = ".".join(str(part) for part in error["loc"])
        message = error["msg"].removeprefix("Value error, ")
        if not setting and ": " in message:
            setting, message = message.split(": ", 1)
        elif error["type"] not in ("extra_forbidden", "unexpected_keyword_argument", "missing"):
            message = f"{message} (got {error['input']!r})"
        problems[setting or "config"] = message
    return problems

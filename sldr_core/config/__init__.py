"""What can be asked for: tasks, methods and the settings of one training."""

from sldr_core.config.methods import LOCOMOTION_METHOD, METHODS, MethodSpec, find_method
from sldr_core.config.tasks import PHASES, TASKS, Phase, TaskSpec, find_task
from sldr_core.config.train import (
    AgentConfig,
    ComputeConfig,
    ExplorationConfig,
    LoopConfig,
    ReplayConfig,
    SceneConfig,
    SldrConfig,
    TrainConfig,
    config_from_dict,
    config_hash,
    config_schema,
    config_to_dict,
)

__all__ = [
    "LOCOMOTION_METHOD",
    "METHODS",
    "PHASES",
    "TASKS",
    "AgentConfig",
    "ComputeConfig",
    "ExplorationConfig",
    "LoopConfig",
    "MethodSpec",
    "Phase",
    "ReplayConfig",
    "SceneConfig",
    "SldrConfig",
    "TaskSpec",
    "TrainConfig",
    "config_from_dict",
    "config_hash",
    "config_schema",
    "config_to_dict",
    "find_method",
    "find_task",
]

"""Simulated Locomotion Demonstration Rewards as a library: environments, agents and training.

Only light names are exported here; `sldr_core.envs` and `sldr_core.training` load MuJoCo and PyTorch.
"""

from sldr_core.config import TrainConfig
from sldr_core.presets import make_config

__all__ = ["TrainConfig", "make_config"]

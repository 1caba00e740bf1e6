"""What was collected, kept on disk, and drawn with goals relabelled in hindsight."""

from sldr_core.replay.buffer import ReplayBuffer, replay_bytes
from sldr_core.replay.curriculum import CurriculumSampler, build_curriculum
from sldr_core.replay.sampler import Sample, Sampler, SamplerOrder
from sldr_core.replay.sampling import HindsightSampler, build_hindsight

__all__ = [
    "CurriculumSampler",
    "HindsightSampler",
    "ReplayBuffer",
    "Sample",
    "Sampler",
    "SamplerOrder",
    "build_curriculum",
    "build_hindsight",
    "replay_bytes",
]

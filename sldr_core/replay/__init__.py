"""What was collected, kept on disk, and drawn with goals relabelled in hindsight."""

from sldr_core.replay.buffer import ReplayBuffer, replay_bytes
from sldr_core.replay.sampling import HindsightSampler, Sample

__all__ = ["HindsightSampler", "ReplayBuffer", "Sample", "replay_bytes"]

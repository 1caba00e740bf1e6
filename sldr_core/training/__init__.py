"""Training and measuring: the composition root, the loop, and what it reads and writes."""

from sldr_core.training.directory import DirectoryRecorder, write_atomically
from sldr_core.training.evaluation import EvaluationResult, evaluate
from sldr_core.training.loop import TrainResult, train
from sldr_core.training.policy import Policy, load_policy
from sldr_core.training.recorder import Recorder, StopReason
from sldr_core.training.resimulation import resimulate

__all__ = [
    "DirectoryRecorder",
    "EvaluationResult",
    "Policy",
    "Recorder",
    "StopReason",
    "TrainResult",
    "evaluate",
    "load_policy",
    "resimulate",
    "train",
    "write_atomically",
]

"""Reward streams: named rewards, each with a critic of its own."""

from sldr_core.streams.sldr import SldrStream
from sldr_core.streams.stream import Stream
from sldr_core.streams.task import TaskStream

__all__ = ["SldrStream", "Stream", "TaskStream"]

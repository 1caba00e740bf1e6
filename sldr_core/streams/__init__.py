"""Reward streams: named rewards, each with a critic of its own."""

from sldr_core.streams.rnd import RndStream, build_rnd
from sldr_core.streams.sldr import SldrStream, build_sldr
from sldr_core.streams.stream import ObjectActions, Stream, StreamOrder
from sldr_core.streams.task import TaskStream

__all__ = ["ObjectActions", "RndStream", "SldrStream", "Stream", "StreamOrder", "TaskStream", "build_rnd", "build_sldr"]

"""Updates on a GPU, captured once as a graph and replayed.

An update is hundreds of small operations, and starting each takes longer than doing it; those of a graph are started
together.
"""

from __future__ import annotations

from collections.abc import Iterator

import torch
from torch import Tensor

from sldr_core.nets.transitions import Transitions
from sldr_core.replay import Sample
from sldr_core.training.updates import Learners, Update, on_device

EAGER_UPDATES = 3
"""Updates before the first capture, which needs all that the first updates make: moments, workspaces, handles."""


class GraphedUpdates:
    """Make updates, the same ones as operation by operation: the first ones so, the others by replaying a graph.

    A graph reads and writes where it did when it was captured, so all batches are copied into one place. That also
    makes a training that goes on from a checkpoint capture anew.
    """

    def __init__(self, learners: Learners, device: torch.device) -> None:
        self._learners = learners
        self._device = device
        self._aside = torch.cuda.Stream(device)
        # Waiting for one of this kind leaves the core to the simulations; any other way of waiting keeps it busy.
        self._done = torch.cuda.Event(blocking=True)
        self._eager_left = EAGER_UPDATES
        self._batch: Transitions | None = None
        self._captured: dict[bool, tuple[torch.cuda.CUDAGraph, Update]] = {}

    def __call__(self, sample: Sample, sync: bool) -> Update:
        """Learn from the sample, and move the targets afterwards if `sync`; return when that is done."""
        update = self._make(self._place(sample), sync)
        self._done.record()
        self._done.synchronize()
        return update

    def _make(self, batch: Transitions, sync: bool) -> Update:
        if self._eager_left:
            self._eager_left -= 1
            return self._update_aside(batch, sync)
        if sync not in self._captured:
            self._captured[sync] = self._capture(batch, sync)
        graph, update = self._captured[sync]
        graph.replay()
        return update

    def _place(self, sample: Sample) -> Transitions:
        """Copy a sample to where all samples go."""
        if self._batch is None:
            self._batch = on_device(sample, self._device)
        else:
            here = on_device(sample, torch.device("cpu"))
            for place, values in zip(_tensors(self._batch), _tensors(here), strict=True):
                place.copy_(values)
        return self._batch

    def _update_aside(self, batch: Transitions, sync: bool) -> Update:
        """Make an update on a stream beside the usual one, as a capture does."""
        usual = torch.cuda.current_stream(self._device)
        self._aside.wait_stream(usual)
        with torch.cuda.stream(self._aside):
            update = self._learners.update(batch, sync)
        usual.wait_stream(self._aside)
        return update

    def _capture(self, batch: Transitions, sync: bool) -> tuple[torch.cuda.CUDAGraph, Update]:
        graph = torch.cuda.CUDAGraph()
        # Episodes are collected meanwhile by another thread, which may go on using the GPU.
        with torch.cuda.graph(graph, stream=self._aside, capture_error_mode="thread_local"):
            update = self._learners.update(batch, sync)
        return graph, update


def _tensors(batch: Transitions) -> Iterator[Tensor]:
    yield from (batch.obs, batch.next_obs, batch.goal, batch.action, batch.reward)
    yield from batch.extra.values()

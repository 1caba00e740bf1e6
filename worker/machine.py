"""What this machine has to train with."""

from __future__ import annotations

import logging
import os
import shutil
import subprocess
from dataclasses import dataclass
from importlib.metadata import version

import psutil

from backend.store.workers import Machine
from sldr_core.errors import SldrError
from sldr_core.processor import count_cores, granted_threads, processor_model

QUERY = ("nvidia-smi", "--query-gpu=index,uuid,name", "--format=csv,noheader")
QUERY_PATIENCE_S = 20.0
"""The driver may have to be loaded first [s]."""
VISIBLE_VARIABLE = "CUDA_VISIBLE_DEVICES"
"""Which GPUs a process may use, by number or name; CUDA's own variable."""

log = logging.getLogger("sldr.worker")


class DriverSilent(SldrError):
    """Report a graphics driver that does not answer."""


@dataclass(frozen=True)
class Gpu:
    """Name one GPU."""

    device: str
    """What CUDA_VISIBLE_DEVICES calls it."""
    name: str
    """Its model."""


def describe_machine(gpus: list[Gpu]) -> Machine:
    """Return what this machine has, with the GPUs that a worker may use."""
    return Machine(
        cores=count_cores(),
        processor=processor_model(),
        gpu=_in_words(gpus),
        memory_total=psutil.virtual_memory().total,
    )


def share_of_threads(slots: int) -> int:
    """Return how many threads a run gets of which so many run at once: more than cores would wait for each other."""
    return max(1, granted_threads() // slots)


def memory_used() -> int:
    """Return how much of the machine's memory is in use [bytes]."""
    memory = psutil.virtual_memory()
    return memory.total - memory.available


def find_gpus() -> list[Gpu]:
    """Return the GPUs that trainings here can use: none where the driver does not answer."""
    try:
        return ask_for_gpus()
    except DriverSilent as err:
        log.warning("%s Trainings use the processor.", err)
        return []


def ask_for_gpus() -> list[Gpu]:
    """Return the GPUs that trainings here can use: none where PyTorch was built without CUDA.

    Raises:
        DriverSilent: the driver does not answer.
    """
    if version("torch").endswith("+cpu") or shutil.which(QUERY[0]) is None:
        return []
    try:
        answer = subprocess.run(QUERY, capture_output=True, text=True, timeout=QUERY_PATIENCE_S, check=False)
    except subprocess.TimeoutExpired as err:
        told = f"The NVIDIA driver does not answer: {QUERY[0]} did not end within {QUERY_PATIENCE_S:g} s."
        raise DriverSilent(told) from err
    if answer.returncode != 0:
        return []
    return visible_gpus(answer.stdout, os.environ.get(VISIBLE_VARIABLE))


def visible_gpus(listed: str, visible: str | None) -> list[Gpu]:
    """Return the GPUs that may be used.

    Args:
        listed: the driver's list, a line of number, id and model for each.
        visible: what CUDA_VISIBLE_DEVICES says; all if None.
    """
    found = [tuple(part.strip() for part in line.split(",", 2)) for line in listed.splitlines() if line.strip()]
    if visible is None:
        return [Gpu(number, model) for number, _, model in found]
    wanted = [word.strip() for word in visible.split(",") if word.strip()]
    return [
        Gpu(word, model)
        for word in wanted
        for number, uuid, model in found
        if word == number or (len(word) > len("GPU-") and uuid.startswith(word))
    ]


def _in_words(gpus: list[Gpu]) -> str | None:
    if not gpus:
        return None
    models = sorted({gpu.name for gpu in gpus})
    return models[0] if len(gpus) == 1 else f"{len(gpus)} x {', '.join(models)}"

"""What this machine has: drawing off screen, a graphics card, room on the disk, a free port."""

from __future__ import annotations

import errno
import os
import shutil
import socket
import subprocess
import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path

from backend.client.access import find_local_server
from worker.doctor.finding import Finding, ok, poor, wrong
from worker.machine import VISIBLE_VARIABLE, DriverSilent, Gpu, ask_for_gpus
from worker.ports import HIGHEST_PORT
from worker.render import MISSING_EGL

DRAWN_WITHIN_S = 60.0
"""Making a renderer takes a second; on a machine that is busy it may take longer [s]."""
PROBE = """
from worker.render import off_screen
with off_screen():
    from worker.media.process import probe_renderer
    probe_renderer()
"""
LITTLE_ROOM = 20 * 10**9
"""Less free space than this is soon used up: one run of the paper's size keeps about 1 GB of replay [bytes]."""
NO_ROOM = 10**9
"""With less free space than this, runs fail [bytes]."""
FEW_NODES = 100_000
"""Fewer free file nodes than this are soon used up."""


def look_at_renderer(command: Sequence[str] = (sys.executable, "-c", PROBE)) -> Finding:
    """Draw something off screen, in a process of its own: a driver that crashes must not take this one with it."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=DRAWN_WITHIN_S, check=False)
    except subprocess.TimeoutExpired:
        mend = "look at the graphics driver, or at /dev/dri and its rights."
        return wrong("drawing", f"Drawing off screen did not end within {DRAWN_WITHIN_S:g} s.", mend)
    if done.returncode == 0:
        return ok("drawing", "MuJoCo draws off screen through EGL: pictures, videos and the camera work.")
    last = (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1]
    return poor("drawing", f"Nothing can be drawn off screen ({last}).", MISSING_EGL.partition("; ")[2] + ".")


def look_at_gpu() -> Finding:
    """See whether trainings can use a graphics card."""
    driver = shutil.which("nvidia-smi") is not None
    try:
        return describe_gpus(ask_for_gpus(), version("torch"), driver, os.environ.get(VISIBLE_VARIABLE))
    except DriverSilent as err:
        return poor("GPU", str(err), "see what `nvidia-smi` says; restarting the machine loads the driver anew.")


def describe_gpus(gpus: Sequence[Gpu], torch: str, has_driver: bool, visible: str | None = None) -> Finding:
    """Say what graphics cards, the build of PyTorch and the driver mean together.

    Args:
        visible: what CUDA_VISIBLE_DEVICES says; None if it is not set.
    """
    if gpus:
        return ok("GPU", f"Trainings can use {', '.join(gpu.name for gpu in gpus)}.")
    if has_driver and torch.endswith("+cpu"):
        mend = "install the build with CUDA: pip install torch==" + torch.partition("+")[0] + " from the usual index."
        return poor("GPU", f"There is an NVIDIA driver, but PyTorch {torch} was built without CUDA.", mend)
    if has_driver and visible is not None:
        told = f"There is an NVIDIA driver, but {VISIBLE_VARIABLE} is '{visible}', which names no card for trainings."
        return poor("GPU", told, "unset it, or let it name a card by number or by its id GPU-...; not by one of MIG.")
    if has_driver:
        return poor("GPU", "There is an NVIDIA driver, but it shows no card.", "see what `nvidia-smi` says.")
    return ok("GPU", "There is none; trainings use the processor.")


def look_at_disk(home: Path) -> Finding:
    """See how much room there is where runs are kept."""
    there = nearest_existing(home)
    usage, nodes = shutil.disk_usage(there), os.statvfs(there)
    return describe_disk(home, usage.free, usage.total, nodes.f_favail if nodes.f_files else None)


def nearest_existing(path: Path) -> Path:
    """Return the path, or what there is already of the directories above it."""
    return next(there for there in (path, *path.parents) if there.exists())


def describe_disk(home: Path, free: int, total: int, free_nodes: int | None) -> Finding:
    """Say what the room on a disk means.

    Args:
        free: what is free [bytes].
        total: what there is [bytes].
        free_nodes: how many more files fit; None where the file system sets no limit.
    """
    told = f"{free / 1e9:.1f} of {total / 1e9:.0f} GB are free where runs are kept ({home})."
    mend = "see `sldr retention --preview`, or let SLDR_HOME name a larger disk."
    if free_nodes is not None and free_nodes < FEW_NODES:
        return poor("disk", f"{told} Only {free_nodes} more files fit.", mend)
    if free < NO_ROOM:
        return wrong("disk", told, mend)
    return poor("disk", told, mend) if free < LITTLE_ROOM else ok("disk", told)


def look_at_port(host: str, port: int) -> Finding:
    """See whether the service could listen, or already does."""
    if not 1 <= port <= HIGHEST_PORT:
        return wrong("port", f"There is no port {port}.", f"choose one from 1 to {HIGHEST_PORT}, such as 8000.")
    served = find_local_server()
    if served is not None and served.endswith(f":{port}"):
        return ok("port", f"The service runs at {served}.")
    try:
        with socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((host, port))
    except OSError as err:
        taken = err.errno == errno.EADDRINUSE
        why = "another program uses it" if taken else err.strerror or str(err)
        mend = f"find it with `ss -ltnp 'sport = :{port}'`, or choose another port: `sldr serve --port {port + 1}`."
        return wrong("port", f"Nobody can listen on {host} port {port}: {why}.", mend)
    return ok("port", f"Port {port} of {host} is free.")

"""What trained the runs of a study, in a few words that name nobody."""

from __future__ import annotations

import platform
from collections.abc import Sequence

from sqlalchemy import Connection, select

from backend.store.study_files.records import LONGEST_MACHINE
from backend.store.tables import attempts, workers

ELSEWHERE = "imported"
"""Stands for the worker where a run came in a study file; its attempt's host is then what the file says of it."""


def count_machines(conn: Connection, run_ids: Sequence[str]) -> str:
    """Return what all attempts of some runs were trained on."""
    hosts = conn.execute(select(attempts.c.host).where(attempts.c.run_id.in_(run_ids)).distinct()).scalars().all()
    count = max(1, len(hosts))
    return f"{platform.machine()}, {count} machine{'s' if count > 1 else ''}"


def find_machines(conn: Connection, run_ids: Sequence[str]) -> dict[str, str]:
    """Return what the last attempt of each run was trained on, for those whose worker or study file has said."""
    found = conn.execute(
        select(
            attempts.c.run_id,
            attempts.c.worker_id,
            attempts.c.host,
            workers.c.cores,
            workers.c.processor,
            workers.c.gpu,
        )
        .outerjoin(workers, workers.c.id == attempts.c.worker_id)
        .where(attempts.c.run_id.in_(run_ids))
        .order_by(attempts.c.attempt)
    )
    told: dict[str, str] = {}
    for row in found:
        if row.worker_id == ELSEWHERE:
            told[row.run_id] = row.host or ""
        elif row.cores:
            told[row.run_id] = _in_words(row.cores, row.processor, row.gpu)
    return told


def _in_words(cores: int, processor: str | None, gpu: str | None) -> str:
    share = f"{cores} core{'s' if cores > 1 else ''}" + (f" of {processor}" if processor else "")
    return f"{platform.machine()}, {share}, {gpu or 'no GPU'}"[:LONGEST_MACHINE]

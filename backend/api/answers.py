"""The store's rows as the API's records, where more than one route answers with them."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any, cast

from backend.api.schemas import Progress, RunDetail, RunSummary
from backend.comparison.variants import changes
from backend.store.files import FileRow
from backend.store.runs import RunRow
from sldr_core.config import Phase

POLICY_FILES = frozenset({"policy-newest.pt", "policy-best.pt"})
"""Files that the 3D viewer can show."""

RECORDING_SUFFIX = ".rrd"
"""Files that Rerun opens."""


def run_summary(row: RunRow) -> RunSummary:
    """Return a run as a row of the table."""
    return RunSummary(**_summary_fields(row))


def run_detail(row: RunRow, files: list[FileRow]) -> RunDetail:
    """Return everything about a run but its curves and logs."""
    return RunDetail(
        **_summary_fields(row),
        config=row.config,
        config_hash=row.config_hash,
        notes=row.notes,
        locomotion_run_id=row.needs[0] if row.needs else None,
        has_policy=has_policy(files),
        has_recording=any(file.name.endswith(RECORDING_SUFFIX) for file in files),
    )


def has_policy(files: list[FileRow]) -> bool:
    """Tell whether there is something to watch in 3D."""
    return any(file.name in POLICY_FILES for file in files)


def _summary_fields(row: RunRow) -> dict[str, Any]:
    return {
        "id": row.id,
        "task": row.task,
        "phase": cast(Phase, row.phase),
        "method": row.method,
        "seed": row.seed,
        "preset": row.preset,
        "state": row.state,
        "reason": row.reason,
        "needs": list(row.needs),
        "attempt": row.attempt,
        "progress": Progress(**asdict(row.progress)) if row.progress else None,
        "created_at": row.created_at,
        "started_at": row.started_at,
        "ended_at": row.ended_at,
        "trained_s": row.training_time.ended_s,
        "training_since": row.training_time.since,
        "cancel_requested": row.cancel_requested,
        "pause_requested": row.pause_requested,
        "is_below_gate": row.is_below_gate,
        "gate_waived": row.gate_waived,
        "priority": row.priority,
        "deleted_at": row.deleted_at,
        "settings_hash": row.settings_hash,
        "changes": changes(row),
        "tags": list(row.tags),
    }

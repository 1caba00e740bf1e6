"""A worker's hold on a run: the record that every write of an attempt carries."""

from __future__ import annotations

import json
from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import Connection, bindparam, update

from backend.store.database import current_time
from backend.store.errors import StaleFence
from backend.store.states import RunState
from backend.store.tables import runs
from sldr_core.config import TrainConfig, config_from_dict, config_to_dict


@dataclass(frozen=True)
class Claim:
    """Say which attempt of which run a worker holds."""

    run_id: str
    """The run."""
    fence: int
    """Rises with each claim of the run; writes with an older one are refused."""
    attempt: int
    """Counts the claims of the run, from 1."""
    worker_id: str
    """Who holds it."""
    config: TrainConfig
    """What to train."""
    locomotion_run_ids: tuple[str, ...]
    """The runs whose locomotion models give the reward."""
    gate_waived: bool
    """Whether a person has let it start although a locomotion model missed the gate."""
    lease_until: datetime
    """Without a heartbeat until then, the run goes to another worker."""


def claim_to_json(claim: Claim) -> str:
    """Return a claim as one line of JSON."""
    return json.dumps(
        {
            "run_id": claim.run_id,
            "fence": claim.fence,
            "attempt": claim.attempt,
            "worker_id": claim.worker_id,
            "config": config_to_dict(claim.config),
            "locomotion_run_ids": claim.locomotion_run_ids,
            "gate_waived": claim.gate_waived,
            "lease_until": claim.lease_until.isoformat(),
        }
    )


def claim_from_json(line: str) -> Claim:
    """Read a claim back from its line of JSON."""
    values = json.loads(line)
    return Claim(
        run_id=values["run_id"],
        fence=values["fence"],
        attempt=values["attempt"],
        worker_id=values["worker_id"],
        config=config_from_dict(values["config"]),
        locomotion_run_ids=tuple(values["locomotion_run_ids"]),
        gate_waived=values.get("gate_waived", False),  # a worker from before an upgrade does not say
        lease_until=datetime.fromisoformat(values["lease_until"]),
    )


def hold_fence(conn: Connection, claim: Claim) -> None:
    """Make sure that the attempt still owns its run until this transaction ends, and stamp its progress.

    Raises:
        StaleFence: the attempt is over.
    """
    held = {"of_run": claim.run_id, "of_fence": claim.fence, "at": current_time(conn)}
    if conn.execute(_STAMP, held).rowcount == 0:
        raise StaleFence(claim.run_id, claim.fence)


# Made once: it is run for every write of every training.
_STAMP = (
    update(runs)
    .where(runs.c.id == bindparam("of_run"), runs.c.fence == bindparam("of_fence"), runs.c.state == RunState.RUNNING)
    .values(progress_at=bindparam("at"))
)

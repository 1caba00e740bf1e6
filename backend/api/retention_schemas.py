"""The API's records of making room: what may go, what would go, what went."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated

from pydantic import Field

from backend.api.schemas import Strict
from backend.store.retention.rule import LONGEST_DAYS, Removable


class RetentionRule(Strict):
    """What may go, and of which runs."""

    # JSON has no enums: the word is taken for one, and nothing else is.
    kinds: Annotated[list[Annotated[Removable, Field(strict=False)]], Field(min_length=1, max_length=len(Removable))]
    older_than_days: int = Field(ge=0, le=LONGEST_DAYS, description="Spare runs that ended later.")


class RemovableSum(Strict):
    """How much of one kind would go."""

    kind: Removable
    files: int
    size: int = Field(description="In bytes.")


class RetentionRun(Strict):
    """What one run would lose."""

    run_id: str
    task: str
    phase: str
    method: str
    seed: int
    state: str
    ended_at: datetime
    files: int
    size: int = Field(description="In bytes.")


class RetentionPreview(Strict):
    """All that a rule would remove."""

    kinds: list[RemovableSum]
    runs: list[RetentionRun] = Field(description="Those with the largest share, the largest first.")
    total_runs: int = Field(description="Runs that would lose something.")
    size: int = Field(description="Of everything, in bytes.")
    spared_young: int = Field(description="Ended runs that lose nothing because they ended too lately.")
    spared_kept: int = Field(description="Those that are tagged `keep` or `starred`.")
    spared_needed: int = Field(description="Those that other runs learn from.")


class RetentionRemoved(Strict):
    """What was removed."""

    runs: int
    files: int
    size: int = Field(description="In bytes.")
    left: int = Field(description="Files that could not be reached; the next time takes them.")

"""What a page may ask the viewer host to show: one record for each kind of 3D view."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from backend.api.schemas import Strict

FileName = Annotated[str, Field(min_length=1, max_length=200)]

NEWEST = "newest"
"""The policy that is followed while it is trained."""


class PolicyChoice(Strict):
    """A policy of another run, or another policy of the same."""

    run_id: str
    policy: FileName = Field(NEWEST, description="`newest` follows the training; else the name of a file of the run.")


class LiveView(Strict):
    """Watch a policy act, toward random goals or goals that are dragged."""

    kind: Literal["live"]
    run_id: str
    policy: FileName = Field(NEWEST, description="`newest` follows the training; else the name of a file of the run.")
    episodes: Literal[1, 4, 9] = Field(1, description="Episodes side by side.")
    beside: PolicyChoice | None = Field(
        None, description="A second policy of the same task and phase, beside the first, from the same start."
    )


class EpisodeView(Strict):
    """Watch an episode that was recorded in a test."""

    kind: Literal["episode"]
    run_id: str
    epoch: int = Field(ge=0)
    index: int = Field(ge=0)


class TimeMachineView(Strict):
    """Watch the episode from one start toward one goal under every policy that was kept while training."""

    kind: Literal["time-machine"]
    run_id: str


class InspectorView(Strict):
    """Look at the demonstrations of a locomotion run's model."""

    kind: Literal["inspector"]
    run_id: str


ViewerRequest = Annotated[LiveView | EpisodeView | TimeMachineView | InspectorView, Field(discriminator="kind")]
"""A request to watch something of a run in 3D."""

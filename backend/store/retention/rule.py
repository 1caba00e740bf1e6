"""Which files of a run may go: a rule is data, and these are pure functions of names and kinds."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from backend.store.files import REPLAY_FILE, REPLAY_LIST
from backend.store.outcomes import CHECKPOINT_KIND
from sldr_core.episodes import KIND as EPISODES_KIND

KEEP_TAGS = frozenset({"keep", "starred"})
"""Runs with one of these tags lose nothing."""
LONGEST_DAYS = 3650
"""A rule spares runs for so many days at most."""
LEFT_CHECKPOINTS = ("checkpoint-previous.pt", "checkpoint-damaged.pt")
"""What a training leaves in its directory beside the checkpoint; no row holds them."""

_EPOCH_POLICY = re.compile(r"policy-epoch-\d+\.pt")


class Removable(StrEnum):
    """What can go."""

    REPLAY = "replay"
    """The replay file and the checkpoints: nearly all of a run's size. A failed run then begins anew if retried."""
    POLICIES = "policies"
    """The policies kept of epochs; the newest and the best stay."""
    EPISODES = "episodes"
    """The recorded test episodes."""
    VIDEOS = "videos"
    """Videos; they can be drawn again as long as what they show is there."""
    RECORDINGS = "recordings"
    """Rerun files; they can be made again from the store."""


KIND_WORDS: Mapping[Removable, str] = {
    Removable.REPLAY: "replay files and checkpoints (a failed or cancelled run then begins anew if retried)",
    Removable.POLICIES: "policies of single epochs (the newest and the best stay)",
    Removable.EPISODES: "recorded test episodes",
    Removable.VIDEOS: "videos",
    Removable.RECORDINGS: "Rerun files (they can be made again)",
}
"""Each kind for a person."""


@dataclass(frozen=True)
class Rule:
    """Say what may go, and of which runs."""

    kinds: frozenset[Removable]
    older_than_days: int
    """Only of runs that ended at least so many days ago."""


def kind_of(name: str, kind: str) -> Removable | None:
    """Return what a registered file is among what can go; None if it stays whatever the rule.

    Args:
        name: the file's name.
        kind: the kind that its row says.
    """
    if kind == CHECKPOINT_KIND or name == REPLAY_LIST:
        return Removable.REPLAY
    if kind == "policy" and _EPOCH_POLICY.fullmatch(name):
        return Removable.POLICIES
    return {EPISODES_KIND: Removable.EPISODES, "video": Removable.VIDEOS, "recording": Removable.RECORDINGS}.get(kind)


def unregistered(rule: Rule) -> tuple[str, ...]:
    """Return the names of files in a run's directory that no row holds and that a rule lets go."""
    return (REPLAY_FILE, *LEFT_CHECKPOINTS) if Removable.REPLAY in rule.kinds else ()

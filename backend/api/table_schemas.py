"""The API's records of the runs table: groups, tags, notes and saved views."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated

from pydantic import Field

from backend.api.queue_schemas import RunIds
from backend.api.schemas import Strict
from backend.store.labels import LONGEST_NOTES, LONGEST_TAG, MOST_TAGS
from backend.store.states import RunState

LONGEST_VIEW_NAME = 80
"""Characters of a view's name."""
LONGEST_SEARCH = 4000
"""Characters of a page's search string."""

TagList = Annotated[
    list[Annotated[str, Field(min_length=1, max_length=LONGEST_TAG)]], Field(default_factory=list, max_length=MOST_TAGS)
]
ViewName = Annotated[str, Field(min_length=1, max_length=LONGEST_VIEW_NAME)]
Search = Annotated[str, Field(max_length=LONGEST_SEARCH)]


class Spread(Strict):
    """The middle half of a group's values."""

    n: int = Field(description="Runs that have a value.")
    lower: float = Field(description="First quartile.")
    median: float
    upper: float = Field(description="Third quartile.")


class RunGroup(Strict):
    """Runs that share what they are grouped by."""

    keys: dict[str, str]
    runs: int
    seeds: list[int] = Field(description="Each once, in their order.")
    states: dict[RunState, int] = Field(description="Runs in each state that occurs.")
    spread: Spread | None = Field(description="Of the metric asked for; null if no run has logged it.")


class RunGroups(Strict):
    """The groups of the runs that pass a filter, in the order asked for."""

    groups: list[RunGroup]
    total: int = Field(description="Runs in all groups.")


class MetricNames(Strict):
    """What runs have logged: each can be a column."""

    names: list[str]


class TagChange(Strict):
    """Tags to give to runs and to take from them: of all of them or, if one does not allow it, of none."""

    run_ids: RunIds
    add: TagList
    remove: TagList


class TagCount(Strict):
    """One tag, and how many runs have it."""

    tag: str
    runs: int


class Tags(Strict):
    """Every tag in use, in the order of the alphabet."""

    tags: list[TagCount]


class Notes(Strict):
    """What people write about a run, as plain text."""

    notes: Annotated[str, Field(max_length=LONGEST_NOTES)]


class NewView(Strict):
    """A view of the runs table to be kept for everyone."""

    name: ViewName
    search: Search = Field(description="The page's search string, without the question mark.")


class ViewChange(Strict):
    """Another name or another search string for a view; what is left out or null stays."""

    name: ViewName | None = None
    search: Search | None = None


class SavedView(Strict):
    """One saved view."""

    id: str
    name: str
    search: str
    created_at: datetime


class SavedViews(Strict):
    """Every saved view, by name."""

    views: list[SavedView]

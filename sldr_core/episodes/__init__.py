"""Recorded test episodes: what is kept of each, how it is written, and what went wrong in it. numpy alone."""

from sldr_core.episodes.files import KIND, episodes_file, read_episodes, write_episodes
from sldr_core.episodes.record import EpisodeSummary, Origin, RecordedEpisode, RecordedTest
from sldr_core.episodes.tags import TAGS, Tag, tag_episodes, tag_shares

__all__ = [
    "KIND",
    "TAGS",
    "EpisodeSummary",
    "Origin",
    "RecordedEpisode",
    "RecordedTest",
    "Tag",
    "episodes_file",
    "read_episodes",
    "tag_episodes",
    "tag_shares",
    "write_episodes",
]

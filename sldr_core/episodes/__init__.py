"""Recorded test episodes: what is kept of each, how it is written, and what went wrong in it. numpy alone."""

from sldr_core.episodes.files import KIND, episode_bytes, episodes_file, epoch_of, read_episodes, write_episodes
from sldr_core.episodes.record import Course, EpisodeSummary, Origin, RecordedEpisode, RecordedTest
from sldr_core.episodes.retention import MOST_FILES, kept_epochs, remove_episodes
from sldr_core.episodes.tags import TAGS, Tag, tag_episodes, tag_shares

__all__ = [
    "KIND",
    "MOST_FILES",
    "TAGS",
    "Course",
    "EpisodeSummary",
    "Origin",
    "RecordedEpisode",
    "RecordedTest",
    "Tag",
    "episode_bytes",
    "episodes_file",
    "epoch_of",
    "kept_epochs",
    "read_episodes",
    "remove_episodes",
    "tag_episodes",
    "tag_shares",
    "write_episodes",
]

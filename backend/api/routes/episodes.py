"""The episodes that a run's tests have recorded: their list, and the timelines of one."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Annotated, Any

from fastapi import APIRouter, Path, Query
from numpy.typing import NDArray

from backend.api.access.declarations import needs
from backend.api.dependencies import Storage, Store
from backend.api.episode_schemas import Episode, EpisodeList, EpisodeTimelines
from backend.api.errors import problem_responses
from backend.store import episodes, files, runs
from sldr_core.episodes import RecordedEpisode, RecordedTest, Tag, read_episodes
from sldr_core.errors import BadFile

LARGEST_PAGE = 200
"""Rows in one answer at most."""

LARGEST_NUMBER = 2**31 - 1
"""Epochs and numbers of episodes are stored as 32 bits."""

Number = Annotated[int, Path(ge=0, le=LARGEST_NUMBER)]

router = APIRouter(prefix="/api/runs/{run_id}/episodes", tags=["runs"])


@router.get("", responses=problem_responses(404, 422))
@needs("viewer", shared=True)
def list_run_episodes(
    run_id: str,
    store: Store,
    tag: Annotated[Tag | None, Query(description="Only episodes that ended so.")] = None,
    epoch: Annotated[int | None, Query(ge=0, le=LARGEST_NUMBER, description="Only those of this test.")] = None,
    sort: Annotated[episodes.EpisodeSort, Query(description="Equal ones stand newest test first.")] = "epoch",
    descending: bool = True,
    limit: Annotated[int, Query(ge=1, le=LARGEST_PAGE)] = 50,
    offset: Annotated[int, Query(ge=0, le=LARGEST_NUMBER, description="Rows to leave out.")] = 0,
) -> EpisodeList:
    """List the recorded episodes of a run's tests."""
    runs.check_run(store, run_id)
    wanted = episodes.EpisodeFilter(tag=tag, epoch=epoch)
    found = episodes.list_episodes(store, run_id, wanted, sort, descending, limit, offset)
    return EpisodeList(episodes=[_episode(row) for row in found.rows], total=found.total, epochs=found.epochs)


@router.get("/{epoch}/{index}", responses=problem_responses(404, 422))
@needs("viewer")
def get_run_episode(run_id: str, epoch: Number, index: Number, store: Store, storage: Storage) -> EpisodeTimelines:
    """Return what happened in one recorded episode, and what the streams and critics said of it."""
    runs.check_run(store, run_id)
    row = episodes.find_episode(store, run_id, epoch, index)
    test = read_episodes(storage.bring(files.find_file(store, run_id, row.file)))
    recorded = next((episode for episode in test.episodes if episode.index == index), None)
    if recorded is None or test.origin.epoch != epoch:
        raise BadFile(f"{row.file} does not hold episode {index} of epoch {epoch}; it belongs to another test.")
    return _timelines(row, test, recorded)


def _episode(row: episodes.EpisodeRow) -> Episode:
    return Episode(**asdict(row.summary), file=row.file, attempt=row.attempt)


def _timelines(row: episodes.EpisodeRow, test: RecordedTest, recorded: RecordedEpisode) -> EpisodeTimelines:
    origin = test.origin
    angle = _numbers(recorded.angle)
    return EpisodeTimelines(
        episode=_episode(row),
        env_steps=origin.env_steps,
        distance=_numbers(recorded.distance),
        angle=None if all(value is None for value in angle) else angle,
        success=recorded.success.tolist(),
        contact={name: recorded.contact[:, column].tolist() for column, name in enumerate(origin.objects)},
        rewards={name: _numbers(recorded.reward[:, column]) for column, name in enumerate(origin.streams)},
        values={name: _numbers(recorded.value[:, column]) for column, name in enumerate(origin.streams)},
        wanted={part: _rows(recorded.wanted[:, column]) for column, part in enumerate(origin.parts)},
        induced={part: _rows(recorded.induced[:, column]) for column, part in enumerate(origin.parts)},
    )


def _numbers(values: NDArray[Any]) -> list[float | None]:
    """Return a column for JSON, which knows finite numbers alone."""
    return [value if math.isfinite(value) else None for value in values.tolist()]


def _rows(values: NDArray[Any]) -> list[list[float | None]]:
    return [_numbers(row) for row in values]

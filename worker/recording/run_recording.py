"""Make the Rerun file of a run from what the store has of it: while it trains, and at any time after."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path

from backend.store.database import Database
from backend.store.errors import FilesUnavailable, NotFound
from backend.store.files import LOG_FILE, FileRow, find_file, list_files
from backend.store.runs import get_run
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from sldr_core.episodes import KIND as EPISODES_KIND
from sldr_core.episodes import read_episodes
from sldr_core.errors import SldrError
from worker.patience import insist
from worker.recording.content import EpisodeScene, Recording
from worker.recording.curves import read_curves
from worker.recording.log_lines import place_lines
from worker.recording.rerun_file import write_recording
from worker.viewer.session_files import RunFiles

NEWEST_EPISODES = 2
"""Episodes of the newest test that are shown in 3D."""
EARLIER_TESTS = 2
"""Earlier tests of which the first episode is shown, spread evenly from the first on."""

log = logging.getLogger(__name__)


def record_run(db: Database, settings: Settings, run_id: str, path: Path) -> None:
    """Write what the store has of a run to a Rerun file.

    Raises:
        NotFound: there is no such run.
        StoreUnavailable: the store cannot be used just now.
    """
    run = insist(lambda: get_run(db, run_id))
    steps, curves = insist(lambda: read_curves(db, run_id))
    storage = FileStorage(settings)
    lines = _read_log(db, settings, storage, run_id)
    title = f"{run.task} {run.method} {run.phase}, seed {run.seed}"
    files = RunFiles(db, settings, storage)
    scenes = _make_scenes(files, run_id)
    write_recording(path, Recording(title, steps, curves, scenes, place_lines(lines, steps)))


def choose_tests(rows: Sequence[FileRow]) -> list[tuple[FileRow, int]]:
    """Return the files of tests whose episodes are shown, the newest first, and how many of each."""
    tests = sorted((row for row in rows if row.kind == EPISODES_KIND), key=lambda row: row.name)
    if not tests:
        return []
    *earlier, newest = tests
    count = min(EARLIER_TESTS, len(earlier))
    chosen = [earlier[len(earlier) * at // count] for at in range(count)]
    return [(newest, NEWEST_EPISODES), *((row, 1) for row in chosen)]


def _make_scenes(files: RunFiles, run_id: str) -> list[EpisodeScene]:
    """Work out a few recorded episodes; what cannot be read is left out, and the log says so."""
    # Brings MuJoCo, which curves do without.
    from worker.recording.demonstrations import Demonstrations
    from worker.recording.scenes import load_scene, make_scene

    scenes: list[EpisodeScene] = []
    known = None
    for row, most in choose_tests(insist(lambda: list_files(files.database, run_id))):
        try:
            test = read_episodes(files.storage.bring(row))
            if known is None:
                model = load_scene(test.origin)
                known = model, Demonstrations(test.origin, model, files.locomotion_models(run_id))
            model, demonstrations = known
            scenes += [
                make_scene(model, test.origin, episode, demonstrations.ways(episode))
                for episode in test.episodes[:most]
            ]
        except (SldrError, FilesUnavailable) as err:
            log.warning("The recording is without %s: %s", row.name, err)
    return scenes


def _read_log(db: Database, settings: Settings, storage: FileStorage, run_id: str) -> list[str]:
    path = settings.run_directory(run_id) / LOG_FILE
    if not path.is_file():
        try:
            path = storage.bring(find_file(db, run_id, LOG_FILE))
        except (NotFound, SldrError, FilesUnavailable):
            return []
    return path.read_text(errors="replace").splitlines()

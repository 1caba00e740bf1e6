"""Where exports take their runs from: the store, or a study file alone."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import closing, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from backend.samples import sample_study
from backend.store.database import Database, open_database
from backend.store.settings import Settings, load_settings, sqlite_url
from backend.store.study_files.placing import import_study
from sldr_core.errors import BadFile

SAMPLE = "sample"
"""Stands for the study file that comes with the product."""


@contextmanager
def open_source(study_file: Path | None) -> Generator[Database]:
    """Lend the store, or one that holds nothing but a study file, for as long as the block lasts.

    Raises:
        BadFile: there is no such study file, or it cannot be taken in.
    """
    if study_file is None:
        with closing(open_database(load_settings())) as db:
            yield db
        return
    source = sample_study() if str(study_file) == SAMPLE else study_file
    if source is None or not source.is_file():
        raise BadFile(f"There is no study file {study_file}; give one that `sldr export study` has written.")
    with TemporaryDirectory(prefix="sldr-study-") as name:
        home = Path(name)
        settings = Settings(home=home, database_url=sqlite_url(home))
        with closing(open_database(settings)) as db:
            import_study(db, settings, source, str(source))
            yield db

"""Where exports take their runs from: the store, or a study file alone."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import closing, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from backend.samples import sample_studies
from backend.store.database import Database, open_database
from backend.store.settings import Settings, load_settings, sqlite_url
from backend.store.study_files.placing import import_study
from sldr_core.errors import BadFile

SAMPLE = "sample"
"""Stands for the study files that come with the product."""


@contextmanager
def open_source(study_file: Path | None) -> Generator[Database]:
    """Lend the store, or one that holds nothing but what comes from study files, for as long as the block lasts.

    Raises:
        BadFile: there is no such study file, or it cannot be taken in.
    """
    if study_file is None:
        with closing(open_database(load_settings())) as db:
            yield db
        return
    sources = sample_studies() if str(study_file) == SAMPLE else (study_file,)
    if not sources or not all(source.is_file() for source in sources):
        raise BadFile(f"There is no study file {study_file}; give one that `sldr export study` has written.")
    with TemporaryDirectory(prefix="sldr-study-") as name:
        home = Path(name)
        settings = Settings(home=home, database_url=sqlite_url(home))
        with closing(open_database(settings)) as db:
            for source in sources:
                import_study(db, settings, source, str(source))
            yield db

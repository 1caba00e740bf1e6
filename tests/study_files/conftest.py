"""One study file, written once, and an empty store to take it in."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

import pytest
from store_engines import SqliteStores
from study_file_cases import trained_study

from backend.store.database import open_database
from backend.store.study_files.packing import pack_study


@pytest.fixture(scope="session")
def exported(sqlite_stores: SqliteStores, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a study file of a study that was trained elsewhere."""
    home = tmp_path_factory.mktemp("elsewhere")
    with sqlite_stores.fresh(home) as settings, closing(open_database(settings)) as db:
        pack_study(db, settings, trained_study(db, settings), home / "study.zip")
    return home / "study.zip"

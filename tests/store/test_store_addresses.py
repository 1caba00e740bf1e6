"""Which store is meant, and what is said of an address that cannot work."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from backend.store.database import open_database
from backend.store.engines import open_engine, parse_address
from backend.store.errors import BadAddress, StoreUnavailable
from backend.store.settings import Settings, load_settings

HOME = Path("/data/sldr")
POSTGRES = "postgresql+psycopg://sldr:secret@127.0.0.1:{port}/sldr"
WITHOUT_DRIVER = """
import sys
sys.modules["psycopg"] = None
from backend.store.engines import open_engine, parse_address
from backend.store.errors import BadAddress
try:
    open_engine(parse_address("postgresql+psycopg://sldr@127.0.0.1/sldr"))
except BadAddress as err:
    print(err)
"""


def test_settings_come_from_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    settings = Settings(home=HOME, database_url=POSTGRES, files_url="s3://bucket/sldr")
    for name, value in settings.as_environment().items():
        monkeypatch.setenv(name, value)

    assert load_settings() == settings


def test_by_default_store_and_files_lie_in_the_data_directory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SLDR_HOME", str(HOME))
    monkeypatch.delenv("SLDR_DATABASE_URL", raising=False)
    monkeypatch.delenv("SLDR_FILES_URL", raising=False)

    assert load_settings() == Settings(home=HOME, database_url="sqlite:////data/sldr/sldr.db", files_url=None)


@pytest.mark.parametrize("scheme", ["postgresql", "postgresql+psycopg"])
def test_postgresql_is_spoken_to_through_psycopg(scheme: str) -> None:
    assert open_engine(parse_address(f"{scheme}://sldr@127.0.0.1/sldr")).driver == "psycopg"


@pytest.mark.parametrize(
    ("address", "sentence"),
    [
        ("/data/sldr.db", "is no address of a database; write sqlite:////path"),
        ("mysql://localhost/sldr", "names a database of the kind 'mysql'"),
        ("postgres://localhost/sldr", "names a database of the kind 'postgres'"),
        ("postgresql+psycopg2://localhost/sldr", "asks for the driver 'psycopg2', and only psycopg is used"),
    ],
)
def test_an_address_that_cannot_work_is_told_in_one_sentence(address: str, sentence: str) -> None:
    with pytest.raises(BadAddress, match=sentence):
        open_engine(parse_address(address))


def test_without_its_driver_postgresql_names_the_extra() -> None:
    said = subprocess.run([sys.executable, "-c", WITHOUT_DRIVER], capture_output=True, text=True, check=True).stdout

    assert said.endswith("pip install '.[postgresql]'.\n")
    assert said.count("\n") == 1


def test_a_server_that_does_not_answer_is_told_without_the_password(tmp_path: Path, free_port: int) -> None:
    with pytest.raises(StoreUnavailable) as caught:
        open_database(Settings(home=tmp_path, database_url=POSTGRES.format(port=free_port)))

    assert "refused" in str(caught.value)
    assert "secret" not in str(caught.value)

"""What a backup is made of: a SQLite store, the files of runs, and a list of both with their checksums.

```
backup.json     written last: with it, the backup is whole
sldr.db         the store, on SQLite whatever it came from
runs/<id>/      the files of a run, by their names
```
Unpacked it is a data directory: `SLDR_HOME` may name a copy of it.
"""

from __future__ import annotations

import json
import os
import shutil
import tarfile
from collections.abc import Generator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Literal

from backend.store.errors import WouldOverwrite
from backend.store.full_disk import explain_no_room
from backend.store.settings import Settings, sqlite_url
from backend.store.storage import checksum
from sldr_core.errors import BadFile

FORMAT = 1
"""Raised when an older program could not read a newer backup."""
LIST_FILE = "backup.json"
STORE_FILE = "sldr.db"
RUNS = "runs"
TarMode = Literal["w", "w:gz"]
TAR_SUFFIXES: Mapping[str, TarMode] = {".tar": "w", ".tgz": "w:gz", ".gz": "w:gz"}
"""How a backup is packed whose name ends so; any other name is that of a directory."""


@dataclass(frozen=True)
class ArchivedFile:
    """One file of a backup."""

    path: str
    """Below the backup's directory."""
    size: int
    """Length [bytes]."""
    sha256: str


@dataclass(frozen=True)
class Contents:
    """The list of a backup."""

    made_at: str
    """When, in UTC (ISO 8601)."""
    version: str
    """Of the program that made it."""
    runs: int
    """How many it holds."""
    files: tuple[ArchivedFile, ...]
    """Everything but the list itself."""
    format: int = FORMAT


def store_settings(directory: Path) -> Settings:
    """Return the settings under which a backup's directory is a data directory."""
    return Settings(home=directory, database_url=sqlite_url(directory))


def list_files_below(directory: Path) -> tuple[ArchivedFile, ...]:
    """Return all files of a backup that is being made."""
    paths = sorted(path for path in directory.rglob("*") if path.is_file() and path.name != LIST_FILE)
    return tuple(
        ArchivedFile(path.relative_to(directory).as_posix(), path.stat().st_size, checksum(path)) for path in paths
    )


def write_contents(directory: Path, contents: Contents) -> None:
    """Write the list of a backup."""
    (directory / LIST_FILE).write_text(json.dumps(asdict(contents), indent=1) + "\n")


def check_target(target: Path, overwrite: bool) -> None:
    """Refuse to make a backup where something lies already; whatever is no backup is never replaced.

    Raises:
        WouldOverwrite: something does.
    """
    is_directory = target.is_dir() and any(target.iterdir())
    if not is_directory and not target.is_file():
        return
    if not ((target / LIST_FILE).is_file() if is_directory else target.suffix in TAR_SUFFIXES):
        raise WouldOverwrite(f"{target} is there already and is no backup; choose another name.")
    if not overwrite:
        raise WouldOverwrite(f"The backup {target} is there already; choose another name, or add --overwrite.")


def put_in_place(stage: Path, target: Path) -> None:
    """Turn the finished directory of a backup into the target, packed if its name says so; replace what is there."""
    mode = TAR_SUFFIXES.get(target.suffix)
    finished = stage if mode is None else _pack(stage, mode)
    os.sync()
    replaced = target.with_name(f".{target.name}.replaced")
    if target.is_dir():
        shutil.rmtree(replaced, ignore_errors=True)  # of a backup that was broken off at this point
        target.rename(replaced)
    finished.rename(target)
    shutil.rmtree(replaced, ignore_errors=True)


def _pack(stage: Path, mode: TarMode) -> Path:
    packed = stage.with_name(f"{stage.name}.tar")
    try:
        with tarfile.open(packed, mode) as tar:
            tar.add(stage, arcname=".")
    except BaseException:
        packed.unlink(missing_ok=True)
        raise
    return packed


@contextmanager
def open_archive(source: Path, scratch: Path) -> Generator[Path]:
    """Lend the directory of a backup, unpacked for as long as the block lasts.

    Args:
        scratch: where to unpack it.

    Raises:
        BadFile: there is no backup, or it cannot be unpacked.
        DiskTooFull: there is no room to unpack it.
    """
    if source.is_dir():
        yield source
        return
    if not source.exists():
        raise BadFile(f"There is no backup {source}; give the file or directory that `sldr backup` has made.")
    with TemporaryDirectory(prefix=".unpacked-", dir=scratch) as name:
        try:
            with explain_no_room(f"what {source} holds", scratch), tarfile.open(source) as tar:
                tar.extractall(name, filter="data")
        except (tarfile.TarError, EOFError, OSError) as err:
            raise BadFile(f"{source} cannot be unpacked ({err}); it is no backup, or not whole.") from err
        yield Path(name)


def read_contents(directory: Path, source: Path) -> Contents:
    """Read the list of a backup and look at every file that it names.

    Args:
        source: what the user calls it.

    Raises:
        BadFile: it is no backup, is not whole, or a file has changed.
    """
    path = directory / LIST_FILE
    if not path.is_file():
        raise BadFile(f"{source} is no whole backup: it has no {LIST_FILE}, which `sldr backup` writes at its end.")
    try:
        values = json.loads(path.read_text())
        files = tuple(ArchivedFile(**file) for file in values.pop("files"))
        contents = Contents(files=files, **values)
    except (AttributeError, KeyError, TypeError, ValueError) as err:
        raise BadFile(f"The {LIST_FILE} of {source} cannot be read ({err}).") from err
    if contents.format > FORMAT:
        raise BadFile(f"{source} was made by version {contents.version}, which is newer; restore it with that one.")
    for file in contents.files:
        _check_file(directory, file, source)
    return contents


def _check_file(directory: Path, file: ArchivedFile, source: Path) -> None:
    path = directory / file.path
    if not path.resolve().is_relative_to(directory.resolve()):
        raise BadFile(f"{source} names {file.path}, which lies outside it; it is no backup of ours.")
    if not path.is_file():
        raise BadFile(f"{source} has lost {file.path}; take another backup.")
    if path.stat().st_size != file.size or checksum(path) != file.sha256:
        raise BadFile(f"{file.path} in {source} is damaged: its checksum is another; take another backup.")

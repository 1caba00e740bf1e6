"""Where the bytes of stored files lie: below the data directory, or at a place that several machines share.

Training always writes in the run's own directory. With a shared place (`SLDR_FILES_URL`, any address that fsspec
knows), what is worth keeping is then put there under a name that is never written twice: the row in the store is the
one thing that changes. So a reader finds either version whole, and an attempt that is over can spoil nothing.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath

from backend.store.errors import BadAddress, FileGone, FilesUnavailable
from backend.store.files import FileRow
from backend.store.place_mark import PlaceMark
from backend.store.settings import FILES_VARIABLE, Settings
from sldr_core.disk import explain_full_disk, temporary_beside
from sldr_core.errors import BadFile

CHUNK = 2**20
"""Read and written at a time [bytes]."""
NAME_DIGITS = 12
"""Hex digits of the checksum that a name carries at the shared place."""


class FileStorage:
    """Keep files, and bring them back. Without a shared place, keeping is leaving them where they are."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._shared = SharedPlace(settings.files_url, settings.known_place_file) if settings.files_url else None

    @property
    def shared(self) -> SharedPlace | None:
        """The place that other machines see as well, if there is one."""
        return self._shared

    def keep(self, run_id: str, attempt: int, local: Path, sha256: str) -> str:
        """Keep a file that an attempt has written in its run's directory; return the path for its row.

        Raises:
            FilesUnavailable: the shared place cannot be written just now.
        """
        if self._shared is None:
            return str(local.relative_to(self._settings.home))
        path = f"{attempt_directory(run_id, attempt)}/{local.stem}-{sha256[:NAME_DIGITS]}{local.suffix}"
        self._shared.put(local, path)
        return path

    def forget(self, path: str) -> None:
        """Remove the bytes of a path that no row holds any more."""
        if self._shared is not None:
            self._shared.remove(path)

    def find_here(self, row: FileRow) -> Path | None:
        """Return the path of a file on this machine, or None if it is only at the shared place, or gone.

        Without a shared place its content is not looked at.
        """
        if self._shared is None:
            path = (self._settings.home / row.path).resolve()
            return path if path.is_relative_to(self._settings.home.resolve()) and path.is_file() else None
        # The run's directory may be left from an attempt on this machine before one elsewhere.
        places = (self._settings.run_directory(row.run_id) / row.name, self._fetched(row))
        return next((place for place in places if _is_that_file(place, row)), None)

    def bring(self, row: FileRow) -> Path:
        """Return the path of a file on this machine, with the very bytes that were registered.

        Raises:
            FileGone: there is no such file any more.
            BadFile: its content has changed.
            FilesUnavailable: the shared place cannot be read just now.
        """
        here = self.find_here(row)
        if self._shared is None:
            path = self._settings.home / row.path
            if here is None:
                raise FileGone(f"{path} is gone.")
            if checksum(path) != row.sha256:
                raise BadFile(f"{path} is not the file that run {row.run_id} wrote; put back the right one.")
            return path
        return here or self.fetch(row)

    def fetch(self, row: FileRow) -> Path:
        """Return a copy from the shared place, renewed if it is of an older version.

        Its path stays the same, whichever machine writes the file: it can be followed.

        Raises:
            FileGone: there is no such file any more, or no shared place.
            BadFile: its content is not what was registered.
            FilesUnavailable: the shared place cannot be read just now.
        """
        copy = self._fetched(row)
        if self._shared is None:
            raise FileGone(f"File {row.name} of run {row.run_id} is at no shared place.")
        if not _is_that_file(copy, row):
            self._shared.get(row.path, copy, row.sha256)
        return copy

    def read(self, row: FileRow, start: int = 0) -> Iterator[bytes]:
        """Read a file from the shared place piece by piece, from byte `start` on.

        Raises:
            FileGone: there is no such file any more, or not of the registered size.
            FilesUnavailable: the shared place cannot be read just now.
        """
        if self._shared is None or self._shared.size(row.path) != row.size:
            raise FileGone(f"File {row.name} of run {row.run_id} is recorded but no longer there.")
        return self._shared.read(row.path, start)

    def _fetched(self, row: FileRow) -> Path:
        return self._settings.fetched_directory / row.run_id / row.name


class SharedPlace:
    """Speak to fsspec in the few words that are needed, and say its many errors in one way."""

    def __init__(self, url: str, known_file: Path | None = None) -> None:
        """Prepare to speak to a place.

        Args:
            url: its address.
            known_file: where this machine notes that it has used the place; None if it need not know it again.

        Raises:
            BadAddress: it cannot be used.
        """
        # Imported here: whoever has no shared place should not wait for it.
        from fsspec.core import url_to_fs

        try:
            self._files, root = url_to_fs(url)
        except ImportError as err:
            raise BadAddress(f"{FILES_VARIABLE} needs a package that is not installed: {err}.") from err
        except ValueError as err:
            raise BadAddress(
                f"{FILES_VARIABLE} cannot be used ({err}); write an address that fsspec knows, as in "
                "file:///mnt/shared/sldr or s3://bucket/sldr."
            ) from err
        self._root = root.rstrip("/")
        self._made: set[str] = set()
        self._mark = PlaceMark(Path(self._root), known_file) if known_file and self._is_on_this_machine else None

    def put(self, local: Path, path: str) -> None:
        """Copy a file there."""
        with self._told("write", path):
            full = self._place_for(path)
            self._files.put_file(str(local), full)
            self._sync(full)
            written = self._files.info(full)["size"]
        if written != local.stat().st_size:
            raise FilesUnavailable(f"{full} came out {written} bytes long instead of {local.stat().st_size}.")

    def put_bytes(self, content: bytes, path: str) -> None:
        """Write a small file there."""
        with self._told("write", path):
            full = self._place_for(path)
            self._files.pipe_file(full, content)
            self._sync(full)

    def get(self, path: str, target: Path, sha256: str) -> None:
        """Copy a file from there; `target` is replaced once the copy is whole.

        Raises:
            FileGone: it is not there.
            BadFile: its content is not what was registered.
        """
        target.parent.mkdir(parents=True, exist_ok=True)
        temporary = temporary_beside(target)
        digest = hashlib.sha256()
        try:
            with explain_full_disk(target), temporary.open("wb") as file:
                for piece in self.read(path):
                    digest.update(piece)
                    file.write(piece)
            if digest.hexdigest() != sha256:
                raise BadFile(f"{self._root}/{path} is damaged: its checksum is not the registered one.")
            temporary.rename(target)
        finally:
            temporary.unlink(missing_ok=True)

    def read(self, path: str, start: int = 0) -> Iterator[bytes]:
        """Read a file piece by piece."""
        with self._told("read", path):
            file = self._files.open(f"{self._root}/{path}", "rb")
        with file:
            file.seek(start)
            while True:
                with self._told("read", path):
                    piece = file.read(CHUNK)
                if not piece:
                    return
                yield piece

    def size(self, path: str) -> int | None:
        """Return the size of a file [bytes], or None if there is none."""
        try:
            with self._told("read", path):
                return self._files.info(f"{self._root}/{path}")["size"]
        except FileGone:
            return None

    def remove(self, path: str) -> None:
        """Remove a file; it may be gone already."""
        try:
            with self._told("remove", path):
                self._files.rm_file(f"{self._root}/{path}")
        except FileGone:
            pass

    def paths_below(self, directory: str) -> list[str]:
        """Return the paths of all files below a directory."""
        with self._told("read", directory):
            self._files.invalidate_cache()
            found = self._files.find(f"{self._root}/{directory}")
        # Some kinds of place leave out the slash that others begin a path with.
        return [path.lstrip("/").removeprefix(self._root.strip("/")).lstrip("/") for path in found]

    @property
    def _is_on_this_machine(self) -> bool:
        """Whether the system itself reaches the place, which may be mounted or not."""
        return "file" in self._files.protocol

    def _place_for(self, path: str) -> str:
        if self._mark is not None:
            self._mark.insist()
        full = PurePosixPath(f"{self._root}/{path}")
        if str(full.parent) not in self._made:
            self._files.makedirs(str(full.parent), exist_ok=True)
            self._made.add(str(full.parent))
        return str(full)

    def _sync(self, full: str) -> None:
        """Bring a file of this machine to its disk; elsewhere the answer to the upload means that."""
        if self._is_on_this_machine:
            descriptor = os.open(full, os.O_RDONLY)
            try:
                os.fsync(descriptor)
            finally:
                os.close(descriptor)

    @contextmanager
    def _told(self, what: str, path: str) -> Generator[None]:
        """Say the errors of any kind of place in our own words."""
        try:
            yield
        except Exception as err:  # Every kind of place has its own: OSError, botocore, aiohttp, google.auth ...
            is_away = what == "write" or (self._mark is not None and self._mark.is_missing())
            if isinstance(err, FileNotFoundError) and not is_away:
                raise FileGone(f"{self._root}/{path} is gone.") from err
            raise FilesUnavailable(
                f"{FILES_VARIABLE}: {self._root}/{path} could not be {_DONE[what]} just now ({err})."
            ) from err


def attempt_directory(run_id: str, attempt: int) -> str:
    """Return the directory at the shared place that only this attempt writes."""
    return f"runs/{run_id}/attempt-{attempt}"


def checksum(path: Path) -> str:
    """Return the sha256 of a file in hex."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _is_that_file(path: Path, row: FileRow) -> bool:
    return path.is_file() and path.stat().st_size == row.size and checksum(path) == row.sha256


_DONE = {"read": "read", "write": "written", "remove": "removed"}

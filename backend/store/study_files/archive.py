"""Reading an archive that may come from anyone: only expected names, never more than promised, no path of its own."""

from __future__ import annotations

import hashlib
import struct
import zlib
from collections.abc import Collection
from pathlib import Path
from types import TracebackType
from typing import BinaryIO
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile, ZipInfo

from backend.store.study_files.records import LARGEST_FILE, Member
from sldr_core.errors import BadFile

MOST_MEMBERS = 20_000
LARGEST_SUM = 2 * 2**30
"""All members unpacked [bytes]."""
LARGEST_RATIO = 200
"""Unpacked by packed size of a member beyond `SMALL`; curves shrink to a tenth, bombs to a thousandth."""
SMALL = 2**20
"""Below this no ratio is looked at [bytes]."""

UNREADABLE = (
    BadZipFile,
    EOFError,
    LookupError,
    NotImplementedError,
    OSError,
    OverflowError,
    RuntimeError,
    UnicodeError,
    ValueError,
    struct.error,
    zlib.error,
)
"""What zipfile raises on archives that are cut short, damaged, encrypted or foreign."""


class HostileArchive:
    """A zip archive of which nothing is believed.

    Raises:
        BadFile: it is no archive, or larger than anything of ours can be.
    """

    def __init__(self, source: Path | BinaryIO, called: str) -> None:
        self._called = called
        try:
            self._zip = ZipFile(source)
        except UNREADABLE as err:
            raise BadFile(f"{called} is no study file: it cannot be unpacked ({_said(err)}).") from err
        try:
            self._members = self._checked(self._zip.infolist())
        except BadFile:
            self._zip.close()
            raise

    def __enter__(self) -> HostileArchive:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._zip.close()

    def expect(self, names: Collection[str]) -> None:
        """Refuse an archive that holds anything but these members, or lacks one.

        Raises:
            BadFile: it does.
        """
        known = set(names)
        for name in self._members:
            if name not in known:
                raise BadFile(f"{self._called} holds {name!r:.120}, which no study file has; it is not taken.")
        missing = sorted(known - self._members.keys())
        if missing:
            raise BadFile(f"{self._called} has lost {missing[0]}; take another copy.")

    def read(self, name: str, largest: int = LARGEST_FILE) -> bytes:
        """Return a member, unpacked no further than it may be long.

        Raises:
            BadFile: it is not there, too long, or damaged.
        """
        info = self._members.get(name)
        if info is None:
            raise BadFile(f"{self._called} is no study file: it has no {name}.")
        try:
            with self._zip.open(info) as file:
                content = file.read(largest + 1)
        except UNREADABLE as err:
            raise BadFile(f"{name} in {self._called} is damaged ({_said(err)}); take another copy.") from err
        if len(content) > largest:
            raise BadFile(f"{name} in {self._called} is longer than {largest / 1e6:.0f} MB; it is not taken.")
        return content

    def read_member(self, name: str, member: Member) -> bytes:
        """Return a member with the very bytes that were promised.

        Raises:
            BadFile: they are others.
        """
        content = self.read(name, member.size)
        if len(content) != member.size or hashlib.sha256(content).hexdigest() != member.sha256:
            raise BadFile(f"{name} in {self._called} is not what its list says; take another copy.")
        return content

    def _checked(self, infos: list[ZipInfo]) -> dict[str, ZipInfo]:
        if len(infos) > MOST_MEMBERS:
            raise BadFile(f"{self._called} holds {len(infos)} files, more than any study; it is not taken.")
        members = {info.filename: info for info in infos}
        if len(members) != len(infos):
            raise BadFile(f"{self._called} holds a file twice; it is not taken.")
        if sum(info.file_size for info in infos) > LARGEST_SUM:
            raise BadFile(f"{self._called} would unpack to more than {LARGEST_SUM / 2**30:.0f} GB; it is not taken.")
        for info in infos:
            if info.compress_type not in (ZIP_STORED, ZIP_DEFLATED):
                raise BadFile(f"{info.filename!r:.120} in {self._called} is packed in a way that is not taken.")
            if info.file_size > SMALL and info.file_size > LARGEST_RATIO * max(info.compress_size, 1):
                raise BadFile(f"{info.filename!r:.120} in {self._called} would unpack to too much; it is not taken.")
        return members


def _said(err: BaseException) -> str:
    return " ".join(str(err).split())[:200] or type(err).__name__

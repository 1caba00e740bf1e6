"""A large file that changes little, kept at the shared place as blocks: only those that changed travel.

The replay file of a run is such a file: hundreds of megabytes, of which some change between two checkpoints.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from backend.store.storage import SharedPlace
from sldr_core.disk import explain_full_disk, temporary_beside
from sldr_core.errors import BadFile

BLOCK = 2**20
"""Size of a block [bytes]: small enough to follow what changed, large enough for few requests."""
ZEROS = hashlib.sha256(bytes(BLOCK)).hexdigest()
"""Checksum of a block in which nothing was written yet."""


@dataclass(frozen=True)
class Block:
    """One block."""

    sha256: str
    path: str | None
    """Where it lies at the shared place; None for one of zeros, which lies nowhere."""


@dataclass(frozen=True)
class BlockList:
    """The blocks that a file is made of."""

    size: int
    """Of the whole file [bytes]."""
    block_size: int
    """Of each block but the last [bytes]."""
    blocks: tuple[Block, ...]

    @property
    def paths(self) -> set[str]:
        """Where the blocks lie."""
        return {block.path for block in self.blocks if block.path is not None}

    def to_json(self) -> str:
        """Return the list as text."""
        rows = [[block.sha256, block.path] for block in self.blocks]
        return json.dumps({"size": self.size, "block_size": self.block_size, "blocks": rows})


EMPTY = BlockList(size=0, block_size=BLOCK, blocks=())
"""The list before anything was put."""


def read_block_list(path: Path) -> BlockList:
    """Read a list back from its file.

    Raises:
        BadFile: the file holds none.
    """
    try:
        values = json.loads(path.read_text())
        blocks = tuple(Block(sha256, place) for sha256, place in values["blocks"])
        return BlockList(int(values["size"]), int(values["block_size"]), blocks)
    except (KeyError, TypeError, ValueError) as err:
        raise BadFile(f"{path} is no list of blocks ({err}).") from err


def put_blocks(place: SharedPlace, file: Path, directory: str, known: BlockList) -> BlockList:
    """Put the blocks of a file that are not there yet into a directory; return the whole list.

    Args:
        known: the newest list of this file; its blocks are used again, wherever they lie.

    Raises:
        FilesUnavailable: the place cannot be written just now.
    """
    there = {block.sha256: block.path for block in known.blocks} | {ZEROS: None}
    blocks: list[Block] = []
    for content in _read_blocks(file):
        digest = hashlib.sha256(content).hexdigest()
        if digest not in there:
            there[digest] = f"{directory}/{digest}"
            place.put_bytes(content, f"{directory}/{digest}")
        blocks.append(Block(digest, there[digest]))
    return BlockList(size=file.stat().st_size, block_size=BLOCK, blocks=tuple(blocks))


def get_blocks(place: SharedPlace, found: BlockList, target: Path) -> None:
    """Put a file together from its blocks; `target` is replaced once it is whole.

    Raises:
        BadFile: a block is damaged.
        DiskTooFull: the file does not fit on this machine's disk.
        FileGone: a block is gone.
        FilesUnavailable: the place cannot be read just now.
    """
    temporary = temporary_beside(target)
    try:
        with explain_full_disk(target), temporary.open("wb") as file:
            # All the space at once: the file will be written through memory, where a full disk would kill.
            os.posix_fallocate(file.fileno(), 0, max(found.size, 1))
            file.truncate(found.size)
            for number, block in enumerate(found.blocks):
                if block.path is not None:
                    file.seek(number * found.block_size)
                    file.write(_get_block(place, block, block.path))
        temporary.rename(target)
    finally:
        temporary.unlink(missing_ok=True)


def _read_blocks(file: Path) -> Iterator[bytes]:
    with file.open("rb") as content:
        while block := content.read(BLOCK):
            yield block


def _get_block(place: SharedPlace, block: Block, path: str) -> bytes:
    content = b"".join(place.read(path))
    if hashlib.sha256(content).hexdigest() != block.sha256:
        raise BadFile(f"The block {path} is damaged: its checksum is not the registered one.")
    return content

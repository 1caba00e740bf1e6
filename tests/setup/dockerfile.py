"""Read a Dockerfile, and do what it says in a directory of this machine: `python dockerfile.py TREE ROOT`.

It stands in for a container engine where there is none: the image's paths lie below ROOT, and the system is this one.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

PATHS_IN_IMAGE = ("/app", "/data")
NOT_DONE = ("FROM", "USER", "EXPOSE", "CMD")
"""Instructions that say what the image is, and do nothing to it."""


@dataclass(frozen=True)
class Instruction:
    """Hold one instruction of a Dockerfile, its lines joined."""

    name: str
    rest: str


def read_dockerfile(path: Path) -> list[Instruction]:
    """Return the instructions of a Dockerfile, in order."""
    lines = [line for line in path.read_text().splitlines() if not line.lstrip().startswith("#")]
    joined = re.sub(r"\\\n\s*", "", "\n".join(lines))
    words = (line.split(maxsplit=1) for line in joined.splitlines() if line.strip())
    return [Instruction(name.upper(), rest) for name, rest in words]


def context_files(tree: Path) -> Iterator[Path]:
    """Give the files below `tree` that .dockerignore lets through, relative to it."""
    ignored = [line for line in (tree / ".dockerignore").read_text().splitlines() if line and line[0] != "#"]
    for folder, folders, files in os.walk(tree):
        here = Path(folder).relative_to(tree)
        folders[:] = [name for name in folders if not _is_ignored(here / name, ignored)]
        yield from (here / name for name in files if not _is_ignored(here / name, ignored))


def build(tree: Path, root: Path) -> None:
    """Do everything that the Dockerfile of `tree` says, below `root`.

    Raises:
        subprocess.CalledProcessError: a command failed.
    """
    inside = _below(root)
    environment = {name: os.environ[name] for name in ("PATH", "HOME") if name in os.environ}
    folder = root
    for instruction in read_dockerfile(tree / "Dockerfile"):
        print(f"{instruction.name} {instruction.rest}", flush=True)
        match instruction.name:
            case "WORKDIR":
                folder = Path(inside(instruction.rest))
                folder.mkdir(parents=True)
            case "COPY":
                *sources, target = shlex.split(instruction.rest)
                _copy(tree, sources, folder / target)
            case "RUN":
                subprocess.run(["/bin/sh", "-c", inside(instruction.rest)], cwd=folder, env=environment, check=True)
            case "ENV":
                for name, value in (word.split("=", 1) for word in shlex.split(instruction.rest)):
                    environment[name] = inside(value).replace("$PATH", environment["PATH"])
            case name if name not in NOT_DONE:
                raise NotImplementedError(f"{name} is not known here; teach it to {__file__}")


def _below(root: Path):
    paths = re.compile(rf"(?<![\w.])({'|'.join(PATHS_IN_IMAGE)})\b")
    return lambda text: paths.sub(lambda found: f"{root}{found[0]}", text)


def _copy(tree: Path, sources: list[str], target: Path) -> None:
    """Copy files, or what is in directories, as COPY does."""
    for source in sources:
        for path in context_files(tree):
            if path == Path(source):
                place = target / path.name
            elif path.is_relative_to(source):
                place = target / path.relative_to(source)
            else:
                continue
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(tree / path, place)


def _is_ignored(path: Path, patterns: list[str]) -> bool:
    return any(
        fnmatch(path.name, pattern.removeprefix("**/")) if pattern.startswith("**/") else path.as_posix() == pattern
        for pattern in patterns
    )


if __name__ == "__main__":
    build(Path(sys.argv[1]), Path(sys.argv[2]))

"""Seeds as a person writes them: `0`, `0-4`, `1,3,7-9`."""

from __future__ import annotations

import re

from sldr_core.errors import InvalidConfig

MOST_SEEDS = 100
"""Seeds of one launch at most."""
SEED_LIMIT = 2**31
"""Every seed is below this."""


def parse_seeds(text: str) -> tuple[int, ...]:
    """Return seeds in ascending order, each once.

    Raises:
        InvalidConfig: they cannot be read, or are too many.
    """
    seeds: set[int] = set()
    for part in (piece.strip() for piece in text.split(",")):
        match = re.fullmatch(r"(\d+)(?:\s*-\s*(\d+))?", part)
        if match is None:
            raise _refused(f"'{part}' is no seed; write whole numbers such as 0,1,2 or a range such as 0-4")
        first, last = int(match[1]), int(match[2] or match[1])
        if last < first:
            raise _refused(f"the range {part} runs backwards; write {last}-{first}")
        if last >= SEED_LIMIT:
            raise _refused(f"seeds must be below {SEED_LIMIT}; {last} is not")
        if last - first >= MOST_SEEDS:
            raise _refused(f"{part} is too many; a launch may have {MOST_SEEDS} seeds")
        seeds.update(range(first, last + 1))
    if len(seeds) > MOST_SEEDS:
        raise _refused(f"these are {len(seeds)} seeds; a launch may have {MOST_SEEDS}")
    return tuple(sorted(seeds))


def _refused(problem: str) -> InvalidConfig:
    return InvalidConfig({"seeds": problem})

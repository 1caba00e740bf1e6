"""Parts of the pages that are written from the code: tables, lists of words, and what each setting means."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, cast

from sldr_core.config import config_schema

SETTING_HEADS = ("setting", "default", "meaning")


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table with these heads over its columns."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def listed(words: Sequence[str]) -> str:
    """Return at least two words as they are told: one, two and three."""
    return f"{', '.join(words[:-1])} and {words[-1]}"


def setting_rows(groups: Iterable[str]) -> Iterator[tuple[str, ...]]:
    """Yield name, default and meaning of every setting in these groups of a config."""
    for group in groups:
        for name, setting in _settings_of(group).items():
            meaning = " ".join(str(setting["description"]).split()).replace("|", "\\|")
            yield (f"`{group}.{name}`", f"`{json.dumps(setting['default'])}`", meaning)


def _settings_of(group: str) -> Mapping[str, Mapping[str, Any]]:
    schema = config_schema()
    record = cast(str, schema["properties"][group]["$ref"]).rpartition("/")[2]
    return cast(dict[str, dict[str, Any]], schema["$defs"][record]["properties"])

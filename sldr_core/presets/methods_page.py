"""The page docs/methods.md, written from the code: `python -m sldr_core.presets.methods_page`."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

from sldr_core.config import (
    METHODS,
    SWITCHES,
    MethodSpec,
    find_task,
    method_switches,
    stream_names,
)
from sldr_core.presets.markdown import SETTING_HEADS, listed, setting_rows, table

PAGE = Path("docs/methods.md")
"""Where the page lies, from the root of the repository."""

COMMAND = "python -m sldr_core.presets.methods_page"

CRITICS_IN = {
    "one object": "FetchPush",
    "2-stack": "FetchStack2",
    "3-stack": "FetchStack3",
    "full hand task": "HandBlockFull",
}
"""A task of each kind by the number of its critics."""

SETTING_GROUPS = ("sldr", "rnd", "curriculum")
"""The groups of settings that only some methods have."""


def methods_page() -> str:
    """Return the whole page, in Markdown."""
    parts = [
        "# Methods",
        f"Written by `{COMMAND}`; change the code instead. Sections and equations are those of the paper.",
        "A method is a combination of four things: what draws the transitions, how many of their goals are replaced in "
        "hindsight, which reward the environment gives, and which further rewards there are. All else is the same. "
        "Every reward is a stream with a critic of its own; the actor climbs the weighted sum of all critics "
        "(Eq. 10 and 11).",
        table(
            ("method", "in the paper", "sampler", "goals replaced", "environment's reward", "further rewards"),
            (_made_of(spec) for spec in METHODS.values()),
        ),
        "## Critics",
        _critics(),
        "## What each does",
        *(_described(spec) for spec in METHODS.values()),
        "## What tells two methods apart",
        f"There are {len(SWITCHES)} switches: {listed(list(SWITCHES.values()))}.",
        table(
            ("method", "other", "differ in"),
            ((f"`{one}`", f"`{other}`", _differences(one, other)) for one, other in combinations(METHODS, 2)),
        ),
        "## Settings that only some methods have",
        "`replay.relabel_probability` is set by the method; an override replaces it, for ablations.",
        table(SETTING_HEADS, setting_rows(SETTING_GROUPS)),
    ]
    return "\n\n".join(parts) + "\n"


def main() -> None:
    """Write the page below the current directory."""
    PAGE.write_text(methods_page(), encoding="utf-8")


def _made_of(spec: MethodSpec) -> tuple[str, ...]:
    further = " and ".join(spec.auxiliary) or "none"
    return (f"`{spec.name}`", spec.title, spec.sampler, f"{spec.relabel_probability:.0%}", spec.reward, further)


def _critics() -> str:
    heads = ("method", *(f"{kind} (`{task}`)" for kind, task in CRITICS_IN.items()))
    rows: list[tuple[str, ...]] = []
    for spec in METHODS.values():
        streams = [stream_names(spec, find_task(task)) for task in CRITICS_IN.values()]
        rows.append((f"`{spec.name}`", *(f"{len(names)}: {', '.join(names)}" for names in streams)))
    return table(heads, rows)


def _described(spec: MethodSpec) -> str:
    phases = "" if "locomotion" in spec.phases else " For manipulation only."
    return f"**`{spec.name}`** ({spec.paper}). {spec.summary} {spec.explanation}{phases}"


def _differences(one: str, other: str) -> str:
    return "; ".join(f"{switch.title}: {switch.first} → {switch.second}" for switch in method_switches(one, other))


if __name__ == "__main__":
    main()

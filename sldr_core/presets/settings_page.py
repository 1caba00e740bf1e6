"""The page docs/settings.md, written from the code: `python -m sldr_core.presets.settings_page`."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from sldr_core.config import LOCOMOTION_METHOD, TASKS, TaskSpec, flatten
from sldr_core.presets import PRESETS, QUICK_GAMMA, Preset, make_config
from sldr_core.presets.markdown import SETTING_HEADS, setting_rows, table

PAGE = Path("docs/settings.md")
"""Where the page lies, from the root of the repository."""

COMMAND = "python -m sldr_core.presets.settings_page"

GROUPS = ("loop", "agent", "exploration", "replay", "scene", "compute")
"""The settings that every method has."""


def settings_page() -> str:
    """Return the whole page, in Markdown."""
    changed = [preset for preset in PRESETS.values() if preset.manipulation or preset.locomotion]
    parts = [
        "# Settings",
        f"Written by `{COMMAND}`; change the code instead.",
        "Every setting of a training is called `group.name`. It stands under **Advanced settings** on the page New run "
        "and under **Settings** on New study; `--set loop.batch_size=256` sets it on the command line, "
        '`settings={"loop": {"batch_size": 256}}` in a script, and several values make an axis of a study. A launch '
        "takes the defaults, lays the task's numbers over them, then the method's, then the preset's, and last what "
        "you set.",
        "## Of every training",
        table(SETTING_HEADS, setting_rows(GROUPS)),
        "What only some methods have (`sldr`, `rnd`, `curriculum`) stands in "
        f"[methods](methods.md#settings-that-only-some-methods-have). {_of_phase_and_task()}",
        "## What presets change",
        *(f"**`{preset.name}`**: {preset.summary}\n\n{_changes_of(preset)}" for preset in changed),
        f"**`paper`** changes nothing: the defaults are the paper's. {PRESETS['paper'].summary}",
        "## Numbers of each task",
        "Epochs and discounts stand for the robot's runs and, behind the stroke, for those of the object alone. A "
        f"robot's run of `quick` has a discount of {QUICK_GAMMA}.",
        table(
            ("task", "steps an episode", "epochs, `paper`", "at most, `quick`", "discount, `paper`", "object, `quick`"),
            (_numbers_of(task) for task in TASKS.values()),
        ),
        "## What differs from the authors' code",
        "Where text and code of the paper differ, tasks follow the text; the networks' view of goals is this product's "
        "own ([results](results.md#what-failures-taught)). `scene.variant=original` takes what stands here instead:",
        table(("tasks", "what `original` has"), _originals()),
        "`object_range`: how far from the middle the object starts [m]. `joint_norm`: success asks for one norm over "
        "all objects, not for each object near its goal. `distance`: how near that is [m]. `stay_on_table`: whether "
        "starts and goals with a block beyond the edge are drawn again. `seen_nearest`: whether networks see the "
        "nearest of equal goals.",
    ]
    return "\n\n".join(parts) + "\n"


def main() -> None:
    """Write the page below the current directory."""
    PAGE.write_text(settings_page(), encoding="utf-8")


def _changes_of(preset: Preset) -> str:
    robot, alone = flatten(preset.manipulation), flatten(preset.locomotion)
    names = dict.fromkeys([*robot, *alone])
    return table(
        ("setting", "robot", "object alone"),
        ((f"`{name}`", _value(robot, name), _value(alone, name)) for name in names),
    )


def _value(settings: Mapping[str, Any], name: str) -> str:
    return f"`{json.dumps(settings[name])}`" if name in settings else "as the paper"


def _numbers_of(task: TaskSpec) -> tuple[str, ...]:
    return (
        f"`{task.name}`",
        f"{task.episode_length}",
        f"{task.paper_epochs} / {task.paper_locomotion_epochs}",
        f"{task.quick_epochs} / {task.quick_locomotion_epochs}",
        f"{task.gamma} / {task.locomotion_gamma}",
        f"{task.quick_locomotion_gamma}",
    )


def _of_phase_and_task() -> str:
    """Tell what follows from phase and task alone."""
    alone = make_config(next(iter(TASKS)), "locomotion", LOCOMOTION_METHOD, 0, "paper").exploration
    limits = {
        f"`agent.{name}`, {getattr(task, name):g} for `{task.name}`"
        for task in TASKS.values()
        for name in ("lowest_return", "lowest_auxiliary_return")
        if getattr(task, name)
    }
    return (
        f"An object alone explores with `exploration.random_action_probability` {alone.random_action_probability} and "
        f"`exploration.noise_std` {alone.noise_std}. With `paper` and `smoke` some tasks "
        f"have limits of their own: {'; '.join(sorted(limits))}."
    )


def _originals() -> Iterator[tuple[str, str]]:
    """Yield what the authors' code has, once for all tasks in which that is the same."""
    tasks: dict[str, list[str]] = {}
    for task in TASKS.values():
        if task.original:
            told = ", ".join(f"`{name}` = {json.dumps(value)}" for name, value in flatten(task.original).items())
            tasks.setdefault(told, []).append(f"`{task.name}`")
    for told, names in tasks.items():
        yield ", ".join(names), told


if __name__ == "__main__":
    main()

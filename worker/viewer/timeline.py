"""The curves below a view: what is known of every transition of its track, as columns that JSON can hold.

Values of transitions have one entry for each step but the last, those of moments one for each step.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from sldr_core.envs import Envs
from worker.viewer.against import Against
from worker.viewer.tracks import Track

Column = list[float | None]

Q_PREFIX = "sldr/"
"""Streams of this name hold q_t."""


def timeline(track: Track, envs: Envs, against: Against | None) -> dict[str, Any]:
    """Return the curves of a track, by `group/name`.

    Groups are `q` (how the robot's move compares with what each part wanted), `reward` and `value` by stream,
    `distance` (to the goal, and to each ghost one step ahead [m]), `angle` (to the goal [rad]) and `contact` (0 or 1).
    """
    known = track.known
    judged = [track.judged(step) for step in range(known)]
    columns: dict[str, Column] = {}
    for name in judged[0].reward if judged else ():
        group = f"q/{name.removeprefix(Q_PREFIX)}" if name.startswith(Q_PREFIX) else f"reward/{name}"
        columns[group] = [each.reward[name] for each in judged]
    for name in judged[0].value if judged else ():
        columns[f"value/{name}"] = [each.value[name] for each in judged]
    columns |= _offsets(track, envs)
    if against is not None:
        distances = [against.distance(track, step) for step in range(known)]
        columns |= {
            f"distance/demonstration of {name}": [each[name] for each in distances]
            for name in (distances[0] if distances else ())
        }
    touches = [track.touches(step) for step in range(known + 1)]
    columns |= {f"contact/{name}": [float(each[name]) for each in touches] for name in touches[0]}
    return {"version": track.version, "known": known, "steps": track.steps, "columns": columns}


def worst_q(columns: dict[str, Column]) -> int | None:
    """Return the first step at which the least q of any part stands; None without one."""
    curves = [column for name, column in columns.items() if name.startswith("q/") and column]
    if not curves:
        return None
    least = np.min(np.asarray(curves, dtype=np.float64), axis=0)
    return int(least.argmin())


def _offsets(track: Track, envs: Envs) -> dict[str, Column]:
    moments = [track.moment(step) for step in range(track.known + 1)]
    offsets = envs.offsets(np.stack([each.achieved for each in moments]), np.stack([each.goal for each in moments]))
    columns: dict[str, Column] = {"distance/goal": offsets.distance.tolist()}
    if not np.isnan(offsets.angle).any():
        columns["angle/goal"] = offsets.angle.tolist()
    return columns

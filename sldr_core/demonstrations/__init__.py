"""Demonstrations: what a locomotion model makes an object do, many at once, and what its critic thinks of the scene.

    inspected = load_inspected(Path("locomotion.pt"))
    envs = inspected.make_envs(BLOCK)
    collection = FanCollection(envs, inspected.act, inspected.starts("FetchPush", envs), seed=0, count=96)
    while collection.advance():
        pass
    summary = summarise(collection.fan().reached)

`N` demonstrations, `T` control steps, `Z` object state, `G` goal, `A` object action.
"""

from sldr_core.demonstrations.collecting import BLOCK, MOST, Demonstration, Fan, FanCollection, demonstrate
from sldr_core.demonstrations.coverage import Axis, CoverageMap, Space, cover
from sldr_core.demonstrations.inspected import Inspected, load_inspected
from sldr_core.demonstrations.landscape import Landscape, Slice, evaluate_slice, evaluate_turns
from sldr_core.demonstrations.outcomes import Failure, Summary, list_failures, steps_to_goal, summarise
from sldr_core.demonstrations.placing import Placing
from sldr_core.demonstrations.slices import SliceChoices, slices_of
from sldr_core.demonstrations.spaces import spaces_of
from sldr_core.demonstrations.starts import Drawn, StackStarts, StartSource, TaskStarts

__all__ = [
    "BLOCK",
    "MOST",
    "Axis",
    "CoverageMap",
    "Demonstration",
    "Drawn",
    "Failure",
    "Fan",
    "FanCollection",
    "Inspected",
    "Landscape",
    "Placing",
    "Slice",
    "SliceChoices",
    "Space",
    "StackStarts",
    "StartSource",
    "Summary",
    "TaskStarts",
    "cover",
    "demonstrate",
    "evaluate_slice",
    "evaluate_turns",
    "list_failures",
    "load_inspected",
    "slices_of",
    "spaces_of",
    "steps_to_goal",
    "summarise",
]

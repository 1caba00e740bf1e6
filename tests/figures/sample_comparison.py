"""Small answers of a comparison, written by hand."""

from __future__ import annotations

from backend.comparison.records import (
    BestModels,
    BestScore,
    CurveComparison,
    CurveLoss,
    Group,
    GroupCurve,
    Member,
    Panel,
    PlainTable,
    SeedScore,
    TableColumn,
    Words,
)
from backend.store.states import RunState

HER = Group(key="her", method="her", variant="", label="HER-Sparse", color=1, dash=1)
WORDS = Words(metric="Test success rate", x="Epoch", statistic="median, band: quartiles (25 to 75 %)")
DONE = RunState.SUCCEEDED

CURVES = CurveComparison(
    version="1",
    metric="test/success_rate",
    x="epoch",
    statistic="median",
    level=0.95,
    words=WORDS,
    groups=[HER],
    panels=[
        Panel(
            task="FetchPush",
            curves=[
                GroupCurve(
                    group="her",
                    n=3,
                    x=[1.0, 2.0],
                    centre=[1 / 3, 0.6],
                    low=[0.1, None],
                    high=[0.5, None],
                    n_at=[3, 2],
                    has_band=True,
                    losses=[CurveLoss(x=1.0, y=1 / 3, before=3, after=2)],
                    holds=False,
                    legend="median of 2 to 3 seeds",
                    members=[Member(run_id="run-of-alice", seed=0, state=DONE, points=2, x=None, y=None)],
                )
            ],
        ),
        Panel(
            task="FetchSlide",
            curves=[
                GroupCurve(
                    group="her",
                    n=1,
                    x=[1.0],
                    centre=[],
                    low=[],
                    high=[],
                    n_at=[1],
                    has_band=False,
                    losses=[],
                    holds=False,
                    legend="1 seed",
                    members=[Member(run_id="other", seed=4, state=DONE, points=1, x=[1.0], y=[0.3])],
                )
            ],
        ),
    ],
    runs=2,
    unread=0,
    every=1,
    left_out=[],
)

BEST = BestModels(
    version="1",
    statistic="median",
    level=0.95,
    words=WORDS,
    groups=[HER],
    scores=[
        BestScore(
            task="FetchPush",
            group="her",
            n=3,
            centre=0.5,
            low=0.25,
            high=0.75,
            seeds=[SeedScore(run_id="run-of-alice", seed=0, state=DONE, best=0.5, epoch=2.0, tests=2)],
        )
    ],
    overall=[],
    overall_tasks=[],
    improvements=[],
    profiles=[],
    efficiency=[],
    tables=[
        PlainTable("scores", "Best", [TableColumn(title="Task"), TableColumn(title="Value")], [["Fetch, Push", 0.1]])
    ],
    runs=1,
    unread=0,
    left_out=[],
)

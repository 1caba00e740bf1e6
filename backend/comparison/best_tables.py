"""The plain tables behind the charts of best models."""

from __future__ import annotations

from collections.abc import Sequence

from backend.comparison.records import (
    BestScore,
    Cell,
    Efficiency,
    Group,
    Improvement,
    OverallScore,
    PlainTable,
    Profile,
    TableColumn,
)

UNITS = {"env_steps": "environment steps", "wall_seconds": "s"}


def make_tables(
    groups: Sequence[Group],
    scores: Sequence[BestScore],
    overall: Sequence[OverallScore],
    improvements: Sequence[Improvement],
    profiles: Sequence[Profile],
    efficiency: Sequence[Efficiency],
) -> list[PlainTable]:
    """Return one table for each chart."""
    labels = {group.key: group.label for group in groups}
    return [
        _scores(scores, labels),
        _overall(overall, labels),
        _improvements(improvements, labels),
        _profiles(profiles, labels),
        _efficiency(efficiency, labels),
    ]


def _scores(scores: Sequence[BestScore], labels: dict[str, str]) -> PlainTable:
    rows: list[list[Cell]] = [
        [
            score.task,
            labels[score.group],
            score.n,
            score.centre,
            score.low,
            score.high,
            " ".join(f"{seed.seed}:{seed.best:.6g}" for seed in score.seeds),
        ]
        for score in scores
    ]
    columns = ("Task", "Method", "Seeds", "Centre", "Low", "High", "Each seed")
    return _table("scores", "Best test success", columns, rows)


def _overall(overall: Sequence[OverallScore], labels: dict[str, str]) -> PlainTable:
    rows: list[list[Cell]] = [
        [labels[score.group], score.tasks, score.n, score.iqm, score.low, score.high] for score in overall
    ]
    columns = ("Method", "Tasks", "Runs", "Interquartile mean", "Low", "High")
    return _table("overall", "Best test success over all shared tasks", columns, rows)


def _improvements(improvements: Sequence[Improvement], labels: dict[str, str]) -> PlainTable:
    rows: list[list[Cell]] = [
        [labels[pair.first], labels[pair.second], pair.tasks, pair.probability, pair.low, pair.high]
        for pair in improvements
    ]
    columns = ("Method", "Better than", "Tasks", "Probability", "Low", "High")
    return _table("improvements", "Probability of improvement", columns, rows)


def _profiles(profiles: Sequence[Profile], labels: dict[str, str]) -> PlainTable:
    rows: list[list[Cell]] = [
        [labels[profile.group], threshold, share, low, high]
        for profile in profiles
        for threshold, share, low, high in zip(
            profile.thresholds, profile.share, profile.low, profile.high, strict=True
        )
    ]
    columns = ("Method", "Test success above", "Share of runs", "Low", "High")
    return _table("profiles", "Performance profile", columns, rows)


def _efficiency(efficiency: Sequence[Efficiency], labels: dict[str, str]) -> PlainTable:
    rows: list[list[Cell]] = [
        [
            effort.task,
            labels[effort.group],
            f"{100 * effort.threshold:g} %",
            UNITS[effort.axis],
            f"{effort.reached} of {effort.n}",
            effort.median,
            effort.low,
            effort.high,
        ]
        for effort in efficiency
    ]
    columns = ("Task", "Method", "Success", "Counted in", "Seeds that reach it", "Median", "First quartile")
    return _table("efficiency", "Needed until a test first reaches a success", (*columns, "Third quartile"), rows)


def _table(name: str, title: str, columns: Sequence[str], rows: list[list[Cell]]) -> PlainTable:
    return PlainTable(name=name, title=title, columns=[TableColumn(title=column) for column in columns], rows=rows)

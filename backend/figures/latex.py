"""Tables for papers: tasks by methods, with the packages booktabs and nothing else."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from backend.comparison.records import BestModels, CurveComparison, Group

SPECIAL = {character: f"\\{character}" for character in "&%$#_{}"} | {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
}


@dataclass(frozen=True)
class Entry:
    """Hold one cell: a number, its interval and how many seeds it is of."""

    value: float
    low: float | None
    high: float | None
    n: int


Entries = Mapping[tuple[str, str], Entry]
"""By task and group key."""


def best_latex(best: BestModels) -> str:
    """Return the best test success of each task and method, the highest of a task in bold."""
    entries = {
        (score.task, score.group): Entry(score.centre, score.low, score.high, score.n)
        for score in best.scores
        if score.centre is not None
    }
    statistic = best.words.statistic.replace("band", "interval")
    return _table(best.groups, entries, f"Best test success: {statistic}", "sldr-best", bold=True)


def curves_latex(comparison: CurveComparison) -> str:
    """Return the last value of each curve that has a band."""
    entries: dict[tuple[str, str], Entry] = {}
    for panel in comparison.panels:
        for curve in panel.curves:
            if curve.has_band and curve.centre[-1] is not None:
                entries[panel.task, curve.group] = Entry(
                    curve.centre[-1], curve.low[-1], curve.high[-1], curve.n_at[-1]
                )
    words = comparison.words
    title = f"{words.metric} at the end of each curve: {words.statistic.replace('band', 'interval')}"
    is_success = comparison.metric.endswith("success_rate")
    return _table(comparison.groups, entries, title, "sldr-curves", bold=is_success)


def escape(text: str) -> str:
    """Return text as LaTeX prints it."""
    return "".join(SPECIAL.get(character, character) for character in text)


def _table(groups: Sequence[Group], entries: Entries, title: str, name: str, bold: bool) -> str:
    tasks = list(dict.fromkeys(task for task, _ in entries))
    shown = [group for group in groups if any(key == group.key for _, key in entries)]
    lines = [
        "% Needs \\usepackage{booktabs}.",
        r"\begin{table}",
        r"\centering",
        rf"\caption{{{escape(title)}. In brackets the interval and the number of seeds.}}",
        rf"\label{{tab:{name}}}",
        rf"\begin{{tabular}}{{l{'c' * len(shown)}}}",
        r"\toprule",
        _row(["Task", *(escape(group.label) for group in shown)]),
        r"\midrule",
        *(_row([escape(task), *_cells(task, shown, entries, bold)]) for task in tasks),
        r"\bottomrule",
        r"\end{tabular}",
        r"\end{table}",
    ]
    return "\n".join(lines) + "\n"


def _cells(task: str, groups: Sequence[Group], entries: Entries, bold: bool) -> list[str]:
    there = [entries[task, group.key] for group in groups if (task, group.key) in entries]
    highest = max(entry.value for entry in there)
    return [
        _cell(entries[task, group.key], bold and entries[task, group.key].value == highest)
        if (task, group.key) in entries
        else "--"
        for group in groups
    ]


def _cell(entry: Entry, is_bold: bool) -> str:
    value = rf"\textbf{{{entry.value:.3f}}}" if is_bold else f"{entry.value:.3f}"
    if entry.low is None or entry.high is None:
        return f"{value} ({entry.n})"
    return f"{value} [{entry.low:.3f}, {entry.high:.3f}] ({entry.n})"


def _row(cells: Sequence[str]) -> str:
    return " & ".join(cells) + r" \\"

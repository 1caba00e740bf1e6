"""Comparisons over seeds: curves, best models, figures and the bundle of everything."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

from backend.client.connection import Connection
from backend.client.errors import ClientError
from backend.client.records.comparisons import BestModels, CurveComparison

FORMATS = ("svg", "pdf", "png", "csv", "tex")
"""What a figure can be written as."""


class Comparisons:
    """Everything that several seeds say together; `client.comparisons`.

    Every question takes the same filters, as in the page's address: `phase`, `task`, `method`, `preset`, `run`
    (each but `phase` one or several) and `study`; and the same view: `metric`, `x`, `statistic`, `level`, `seeds`,
    `drop_ended`.
    """

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def curves(self, **question: Any) -> CurveComparison:
        """Return learning curves, one panel a task, one curve a group of seeds."""
        return self._connection.ask(CurveComparison, "/api/compare", **question)

    def best(self, **question: Any) -> BestModels:
        """Return what the best models reach: scores, improvement, and plain tables."""
        return self._connection.ask(BestModels, "/api/compare/best", **question)

    def figure(self, out: Path | str, kind: Literal["curves", "best"] = "curves", **question: Any) -> Path:
        """Have a figure drawn, or its numbers written, and return where it lies.

        Args:
            out: the file to write; its ending says what: .svg, .pdf, .png, .csv or .tex.

        Raises:
            ClientError: the ending is none of these.
        """
        path = Path(out)
        form = path.suffix.removeprefix(".")
        if form not in FORMATS:
            raise ClientError(f"No figure ends in '{path.suffix}'; there are {', '.join(FORMATS)}.")
        path.write_bytes(self._connection.ask_bytes(f"/api/compare/figure.{form}", kind=kind, **question))
        return path

    def bundle(self, out: Path | str, anonymous: bool = False, **question: Any) -> Path:
        """Have figures, numbers, configs, versions and seeds packed into one .zip, and return where it lies.

        Args:
            anonymous: leave out what tells who made it, and where.
        """
        path = Path(out)
        path.write_bytes(self._connection.ask_bytes("/api/compare/bundle.zip", anonymous=anonymous, **question))
        return path

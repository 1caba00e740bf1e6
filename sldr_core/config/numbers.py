"""Ranges of numbers that settings share."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

MOST = 1_000_000_000_000
"""The largest whole number of a setting: far beyond what any training counts to, and products of several stay finite
as floats, so that time and disk space can be told."""

Positive = Annotated[int, Field(gt=0, le=MOST)]
"""A whole number from 1."""

Count = Annotated[int, Field(ge=0, le=MOST)]
"""A whole number from 0."""

Share = Annotated[float, Field(ge=0.0, le=1.0)]
"""A number from 0 to 1."""

Rate = Annotated[float, Field(gt=0.0, lt=1.0)]
"""A number between 0 and 1."""

Weight = Annotated[float, Field(ge=0.0)]
"""A number from 0."""

Return = Annotated[float, Field(le=0.0)]
"""A number up to 0."""

"""Ranges of numbers that settings share."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

Positive = Annotated[int, Field(gt=0)]
"""A whole number from 1."""

Share = Annotated[float, Field(ge=0.0, le=1.0)]
"""A number from 0 to 1."""

Rate = Annotated[float, Field(gt=0.0, lt=1.0)]
"""A number between 0 and 1."""

Weight = Annotated[float, Field(ge=0.0)]
"""A number from 0."""

Return = Annotated[float, Field(le=0.0)]
"""A number up to 0."""

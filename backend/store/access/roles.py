"""What people and programs may do: three roles, each with all that the one before it may."""

from __future__ import annotations

from typing import Literal, get_args

Role = Literal["viewer", "operator", "admin"]
"""A viewer reads; an operator also launches, ends, tags and writes; an admin also decides who may do what."""

ROLES: tuple[Role, ...] = get_args(Role)


def allows(role: Role, needed: Role) -> bool:
    """Tell whether a role may do what needs another."""
    return ROLES.index(role) >= ROLES.index(needed)


def lesser(one: Role, other: Role) -> Role:
    """Return which of two roles may do less."""
    return one if ROLES.index(one) <= ROLES.index(other) else other

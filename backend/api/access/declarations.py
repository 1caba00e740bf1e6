"""What each route asks of its caller, said at the route itself. A route that says nothing answers nobody."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from backend.store.access.roles import Role

ATTRIBUTE = "sldr_access"
"""Where a route's function carries what it asks."""

Endpoint = TypeVar("Endpoint", bound=Callable[..., Any])


@dataclass(frozen=True)
class Declaration:
    """Say who may call a route."""

    role: Role | None
    """The least role; None: everybody may, signed in or not."""
    is_audited: bool
    """Whether what it did is written into the audit log."""
    is_shared: bool = False
    """Whether its answer is the same for everybody who may call it, and may be a moment old for those who say so."""


def needs(role: Role, audited: bool | None = None, shared: bool = False) -> Callable[[Endpoint], Endpoint]:
    """Let a route answer to this role and those above it.

    Args:
        role: the least role.
        audited: whether changes that it makes are written into the audit log; if not said, for all roles but viewers.
        shared: whether its answer is the same for everybody; only what every role may read can be.
    """
    assert not shared or role == "viewer", "an answer for some roles only would reach the others"
    return _declare(Declaration(role, role != "viewer" if audited is None else audited, shared))


def open_to_all(endpoint: Endpoint) -> Endpoint:
    """Let a route answer to everybody: what is needed to sign in, and whether the service is well."""
    return _declare(Declaration(None, is_audited=False))(endpoint)


def open_and_shared(endpoint: Endpoint) -> Endpoint:
    """Let a route answer to everybody, and the same to all who ask within a moment."""
    return _declare(Declaration(None, is_audited=False, is_shared=True))(endpoint)


def declaration_of(endpoint: object) -> Declaration | None:
    """Return what a route's function asks of its caller, or None if it says nothing."""
    return getattr(endpoint, ATTRIBUTE, None)


def _declare(declaration: Declaration) -> Callable[[Endpoint], Endpoint]:
    def mark(endpoint: Endpoint) -> Endpoint:
        setattr(endpoint, ATTRIBUTE, declaration)
        return endpoint

    return mark

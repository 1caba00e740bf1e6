"""Host rule: the server answers only to names that are its own.

Another site can point a name of its own at this machine (DNS rebinding), and its page would then count as ours. Such a
request carries that site's name in its Host header, and is refused for it.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from ipaddress import ip_address
from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket

from backend.api.errors import problem, problem_answer

HOSTS_VARIABLE = "SLDR_ALLOWED_HOSTS"
"""Further names that the server answers to, separated by commas."""

OWN_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})
EVERY_ADDRESS = frozenset({"", "0.0.0.0", "::"})
"""Bound to one of these, the server listens on every address of the machine."""


@dataclass(frozen=True)
class HostRule:
    """Say which names are ours."""

    bound: str = "127.0.0.1"
    """The address that the server listens on."""
    allowed: frozenset[str] = field(default_factory=frozenset[str])
    """Names that somebody has allowed besides."""

    def is_ours(self, host: str) -> bool:
        """Tell whether a Host header, with or without a port, names this server."""
        name = _name_of(host)
        if name is None:
            return False
        if self.bound in EVERY_ADDRESS and _is_address(name):
            return True  # Plain addresses cannot be rebound, and any of the machine's may be meant.
        return name in OWN_NAMES | {self.bound.lower()} | self.allowed


LOCAL = HostRule()
"""The rule of a server that listens on this machine only."""


def load_host_rule(bound: str) -> HostRule:
    """Return the rule of a server that listens on `bound`, with the names allowed by the environment."""
    names = os.environ.get(HOSTS_VARIABLE, "").split(",")
    return HostRule(bound, frozenset(name.strip().lower() for name in names if name.strip()))


class OwnHost:
    """Refuse requests and websockets for names that are not ours."""

    def __init__(self, app: ASGIApp, rule: HostRule) -> None:
        self._app = app
        self._rule = rule

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on what is meant for us, answer 403 to the rest."""
        host = Headers(scope=scope).get("host", "") if scope["type"] != "lifespan" else None
        if host is None or self._rule.is_ours(host):
            await self._app(scope, receive, send)
            return
        message = (
            f"This server does not answer to '{host}'; open it as localhost, "
            f"or start it with {HOSTS_VARIABLE} naming the hosts it may answer to."
        )
        answer = problem_answer(403, [problem(message)])
        if scope["type"] == "websocket":
            await WebSocket(scope, receive, send).send_denial_response(answer)
        else:
            await answer(scope, receive, send)


def _name_of(host: str) -> str | None:
    """Return the name in a Host header in lower case, without port and brackets; None if there is none."""
    try:
        return urlsplit(f"//{host}").hostname
    except ValueError:
        return None


def _is_address(name: str) -> bool:
    try:
        ip_address(name)
    except ValueError:
        return False
    return True

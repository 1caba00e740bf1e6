"""Which addresses may be told: services of others over HTTP, never this machine's own.

A name is resolved once, every address that it stands for is judged, and the connection goes to one that was judged.
So a name cannot turn into another address between look and leap.
"""

from __future__ import annotations

import ipaddress
import socket
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from urllib.parse import urlsplit

from sldr_core.errors import InvalidConfig, SldrError

IpAddress = ipaddress.IPv4Address | ipaddress.IPv6Address
Resolve = Callable[[str, int], Sequence[str]]
"""Returns the addresses that a name stands for."""

LONGEST_URL = 2000
"""Characters of an address."""
USUAL_PORTS = {"http": 80, "https": 443}
THIS_NETWORK = ipaddress.ip_network("0.0.0.0/8")
"""Addresses that reach this machine on some systems."""
NAT64 = ipaddress.ip_network("64:ff9b::/96")
"""Addresses that a gateway translates; the last 32 bits are of the old kind."""


class TargetRefused(SldrError):
    """Report an address that may not be told."""


@dataclass(frozen=True)
class Target:
    """Where a message goes, judged."""

    url: str
    host: str
    """The name as it was written: for the request's head and for the certificate."""
    port: int
    address: str
    """The address that it stands for and that may be told."""


def check_url(url: str) -> tuple[str, int]:
    """Return the host and port of an address that could be told.

    Raises:
        InvalidConfig: it is no http or https address, or holds a password.
    """
    try:
        parts = urlsplit(url)
        host, port = parts.hostname, parts.port
    except ValueError:
        raise _unfit("it cannot be read") from None
    if len(url) > LONGEST_URL or not url.isascii() or not url.isprintable() or any(mark in url for mark in " \\"):
        raise _unfit("it is too long, or holds what no address holds")
    if parts.scheme not in USUAL_PORTS or not host:
        raise _unfit("it does not begin with https:// or http:// and the name of a host")
    if "@" in parts.netloc:
        raise _unfit("it holds a name or password; leave them out, messages are signed instead")
    if port == 0:
        raise _unfit("port 0 is none")
    return host, port or USUAL_PORTS[parts.scheme]


def find_target(url: str, allow_local: bool, resolve: Resolve | None = None) -> Target:
    """Return where to send to.

    Args:
        allow_local: whether this machine itself and its link may be told.
        resolve: asks for the addresses of a name; the system's way if None.

    Raises:
        InvalidConfig: it is no address that could be told.
        TargetRefused: it cannot be found, or stands for an address that may not be told.
    """
    host, port = check_url(url)
    try:
        found = (resolve or resolve_name)(host, port)
    except (OSError, UnicodeError) as err:
        raise TargetRefused(f"'{host}' cannot be found ({getattr(err, 'strerror', None) or err}).") from err
    for address in found:
        why = why_refused(ipaddress.ip_address(address.partition("%")[0]), allow_local)
        if why is not None:
            raise TargetRefused(f"'{host}' stands for {address}, {why}; it is not told.")
    if not found:
        raise TargetRefused(f"'{host}' stands for no address.")
    return Target(url, host, port, found[0])


def why_refused(address: IpAddress, allow_local: bool) -> str | None:
    """Return why an address may not be told, or None if it may."""
    for part in (address, *_within(address)):
        if part.is_multicast or part.is_unspecified or (part.version == 4 and part in THIS_NETWORK):
            return "which is no single machine"
        if not allow_local and (part.is_loopback or part.is_link_local):
            return "which is this machine or its own link"
    return None


def resolve_name(host: str, port: int) -> list[str]:
    """Return the addresses that a name stands for, as the system finds them."""
    found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    return list(dict.fromkeys(str(entry[4][0]) for entry in found))


def _within(address: IpAddress) -> Iterable[IpAddress]:
    """Return the addresses of the old kind that one of the new kind stands for."""
    if isinstance(address, ipaddress.IPv4Address):
        return []
    found = [address.ipv4_mapped, address.sixtofour, *(address.teredo or ())]
    if address in NAT64 or (int(address) >> 32 == 0 and not address.is_loopback):
        found.append(ipaddress.IPv4Address(int(address) & 0xFFFFFFFF))
    return [part for part in found if part is not None]


def _unfit(why: str) -> InvalidConfig:
    return InvalidConfig({"url": f"{why}; write one such as https://chat.example.org/hooks/abc."})

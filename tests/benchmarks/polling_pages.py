"""Many browsers with a live page open, as the server sees them: what each page asks for, how often, with which headers.

They run in a process of their own, and cost little, so that a training beside them suffers from the server alone.
"""

from __future__ import annotations

import asyncio
import gzip
import json
import multiprocessing
import random
import re
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection

POLL_S, SLOW_POLL_S = 2.0, 5.0
"""How often pages ask, as `POLL_MS` and `SLOW_POLL_MS` of the page say [s]."""

ON_EVERY_PAGE = (("/healthz", SLOW_POLL_S),)
GROWING = ("metrics", "log")
"""What is asked for from where the last answer ended, and the field that says where that was."""
CURSORS = {"metrics": "cursor", "log": "offset"}


@dataclass(frozen=True)
class OpenPage:
    """A page that somebody has open."""

    asks: Sequence[tuple[str, float]]
    """Addresses, and how often each is asked for [s]."""
    cookie: str


@dataclass
class Polled:
    """What came of a while of polling."""

    seconds: list[float] = field(default_factory=list[float])
    """How long each answer took, to its last byte [s]."""
    statuses: dict[int, int] = field(default_factory=dict[int, int])
    """Answers by status."""
    received: int = 0
    """All that came [bytes]."""
    cpu_s: float = 0.0
    """What the browsers themselves took of a core [s]."""


def runs_table() -> list[tuple[str, float]]:
    """Return what the runs table asks for."""
    return [("/api/runs?deleted=false&sort=launched&descending=true&offset=0&limit=50", POLL_S), *ON_EVERY_PAGE]


def run_page(run_id: str) -> list[tuple[str, float]]:
    """Return what the page of a live run asks for, its curves and its log."""
    run = f"/api/runs/{run_id}"
    return [(run, POLL_S), (f"{run}/metrics?superseded=true", POLL_S), (f"{run}/log?", POLL_S), *ON_EVERY_PAGE]


def queue_page() -> list[tuple[str, float]]:
    """Return what the queue asks for."""
    return [("/api/queue?limit=200", POLL_S), *ON_EVERY_PAGE]


def compare_page() -> list[tuple[str, float]]:
    """Return what the compare page asks for."""
    view = "metric=test/success_rate&x=epoch&statistic=median&level=0.95&seeds=false"
    return [(f"/api/compare?{view}", SLOW_POLL_S), *ON_EVERY_PAGE]


@contextmanager
def browsers(port: int, pages: Sequence[OpenPage]) -> Iterator[Connection]:
    """Lend a line to a process full of browsers: send seconds, and `Polled` comes back when they are over."""
    context = multiprocessing.get_context("spawn")
    here, there = context.Pipe()
    process = context.Process(target=_wait_and_poll, args=(there, port, pages), daemon=True)
    process.start()
    # With this end open here too, one would wait for ever for browsers that have died.
    there.close()
    try:
        yield here
    finally:
        process.kill()
        process.join()


def _wait_and_poll(orders: Connection, port: int, pages: Sequence[OpenPage]) -> None:
    while True:
        orders.send(asyncio.run(poll(port, pages, orders.recv())))


async def poll(port: int, pages: Sequence[OpenPage], seconds: float) -> Polled:
    """Keep all pages open for some seconds."""
    polled, drawn, cpu_s = Polled(), random.Random(0), time.process_time()
    until = time.monotonic() + seconds
    asking = [
        _keep_asking(port, page.cookie, path, every_s, drawn.uniform(0.0, every_s), until, polled)
        for page in pages
        for path, every_s in page.asks
    ]
    await asyncio.gather(*asking)
    polled.cpu_s = time.process_time() - cpu_s
    return polled


async def _keep_asking(
    port: int, cookie: str, path: str, every_s: float, begin_s: float, until: float, polled: Polled
) -> None:
    """Ask for one address again and again."""
    await asyncio.sleep(begin_s)
    line = _Line(port)
    etag, after = "", ""
    due = time.monotonic()
    while due < until:
        status, headers, body = await line.ask(_request(port, path + after, cookie, etag))
        polled.seconds.append(time.monotonic() - due)
        polled.statuses[status] = polled.statuses.get(status, 0) + 1
        polled.received += len(body) + sum(map(len, headers.values()))
        moved = _after(path, headers, body) or after
        # A browser keeps an answer by its whole address.
        etag, after = headers.get("etag", "") if moved == after else "", moved
        due = max(due + every_s, time.monotonic())
        await asyncio.sleep(max(0.0, due - time.monotonic()))
    line.close()


class _Line:
    """A connection that is kept open, and opened anew if the service has closed it meanwhile, as a browser does."""

    def __init__(self, port: int) -> None:
        self._port = port
        self._streams: tuple[asyncio.StreamReader, asyncio.StreamWriter] | None = None

    async def ask(self, request: bytes) -> tuple[int, dict[str, str], bytes]:
        """Return status, headers and body of an answer."""
        if self._streams is not None:
            with suppress(asyncio.IncompleteReadError, ConnectionError):
                return await self._ask(*self._streams, request)
            self.close()
        self._streams = await asyncio.open_connection("127.0.0.1", self._port)
        return await self._ask(*self._streams, request)

    def close(self) -> None:
        """Hang up."""
        if self._streams is not None:
            self._streams[1].close()
            self._streams = None

    async def _ask(
        self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, request: bytes
    ) -> tuple[int, dict[str, str], bytes]:
        writer.write(request)
        return await _read_answer(reader)


def _request(port: int, path: str, cookie: str, etag: str) -> bytes:
    lines = [
        f"GET {path} HTTP/1.1",
        f"Host: 127.0.0.1:{port}",
        f"Cookie: {cookie}",
        "Accept-Encoding: gzip, deflate, br",
        "Cache-Control: max-age=1",
        "Sec-Fetch-Site: same-origin",
        *([f"If-None-Match: {etag}"] if etag else []),
    ]
    return "\r\n".join([*lines, "", ""]).encode()


async def _read_answer(reader: asyncio.StreamReader) -> tuple[int, dict[str, str], bytes]:
    head = (await reader.readuntil(b"\r\n\r\n")).decode("latin-1").split("\r\n")
    headers = {name.lower(): value for name, _, value in (line.partition(": ") for line in head[1:] if line)}
    status = int(head[0].split()[1])
    body = await reader.readexactly(int(headers.get("content-length", "0"))) if status != 304 else b""
    return status, headers, body


def _after(path: str, headers: dict[str, str], body: bytes) -> str | None:
    """Return what to add to an address that grows, so that the next answer goes on where this one ended."""
    found = re.search(rf"/({'|'.join(GROWING)})\?", path)
    if found is None or not body:
        return None
    content = gzip.decompress(body) if headers.get("content-encoding") == "gzip" else body
    return f"&after={json.loads(content)[CURSORS[found[1]]]}"

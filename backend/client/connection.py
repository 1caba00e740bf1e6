"""Speaking HTTP to the service: questions that are asked again, wishes that are not, and files."""

from __future__ import annotations

import hashlib
import secrets
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

import httpx
from pydantic import TypeAdapter, ValidationError

from backend.client.access import is_loopback
from backend.client.errors import BadAnswer, NotReachable, Problem, error_for

Record = TypeVar("Record")

ANSWER_S = 60.0
"""How long an answer may take [s]."""
DRAWN_S = 300.0
"""How long figures may take: the service draws for two minutes at most, when others let it [s]."""
CONNECT_S = 10.0
"""How long it may take until somebody answers at all [s]."""
TRIES = 4
"""A question is asked so often before it is given up; wishes are told once."""
FIRST_PAUSE_S = 0.5
"""Pause before a question is asked again; doubled each time [s]."""
AWAY = 503
"""The status of a service whose store cannot be used just now."""


class Connection:
    """Ask and tell one service. Share one between threads."""

    def __init__(self, url: str, token: str | None, pause: Callable[[float], None] = time.sleep) -> None:
        self.url = url
        self._pause = pause
        self._http = httpx.Client(
            base_url=url,
            headers={} if token is None else {"Authorization": f"Bearer {token}"},
            timeout=httpx.Timeout(ANSWER_S, connect=CONNECT_S),
            # A proxy of the environment does not lead back to this machine.
            trust_env=not is_loopback(url),
        )

    def close(self) -> None:
        """Close all connections."""
        self._http.close()

    def ask(self, kind: type[Record], path: str, part: str | None = None, **query: Any) -> Record:
        """Return what a GET answers, read as a record.

        Args:
            part: the field of the answer that is wanted; all of it if None.
            query: its query string; what is None is left out.

        Raises:
            ClientError: it was not answered.
        """
        return self._read(kind, self._ask(path, query), part)

    def ask_bytes(self, path: str, **query: Any) -> bytes:
        """Return the body that a GET answers: figures, which take long to draw and are therefore asked for once.

        Raises:
            ClientError: it was not answered.
        """
        return self._ask(path, query, DRAWN_S, again_if_slow=False).content

    def tell(self, kind: type[Record], method: str, path: str, body: Any = None, part: str | None = None) -> Record:
        """Send a wish, once, and return the answer read as a record; `None` for a wish that has no answer.

        Raises:
            ClientError: it was refused, or nobody knows what became of it.
        """
        with self._speaking():
            answer = self._http.request(method, path, json=body)
        _check(answer)
        return self._read(kind, answer, part)

    def fetch(self, path: str, target: Path, sha256: str) -> None:
        """Write a file to `target`, which is replaced once the copy is whole.

        Raises:
            BadAnswer: it came damaged.
            ClientError: it was not answered.
        """
        temporary = target.with_name(f".{target.name}.{secrets.token_hex(6)}.tmp")
        digest = hashlib.sha256()
        try:
            with self._speaking(), self._http.stream("GET", path) as answer, temporary.open("wb") as file:
                if answer.is_error:
                    answer.read()
                    _check(answer)
                for piece in answer.iter_bytes():
                    digest.update(piece)
                    file.write(piece)
            if digest.hexdigest() != sha256:
                raise BadAnswer(f"{path} came damaged: its checksum is not the registered one; try again.")
            temporary.rename(target)
        finally:
            temporary.unlink(missing_ok=True)

    def _ask(
        self, path: str, query: Mapping[str, Any], answer_s: float = ANSWER_S, again_if_slow: bool = True
    ) -> httpx.Response:
        given = {name: value for name, value in query.items() if value is not None}
        for turn in range(TRIES):
            is_last = turn == TRIES - 1
            try:
                with self._speaking():
                    answer = self._http.get(path, params=given, timeout=httpx.Timeout(answer_s, connect=CONNECT_S))
                if answer.status_code != AWAY or is_last:
                    _check(answer)
                    return answer
            except NotReachable as err:
                if is_last or (not again_if_slow and isinstance(err.__cause__, httpx.ReadTimeout)):
                    raise
            self._pause(FIRST_PAUSE_S * 2**turn)
        raise AssertionError("the last turn answers or raises")

    @contextmanager
    def _speaking(self) -> Iterator[None]:
        """Say what keeps HTTP from working in our own words."""
        try:
            yield
        except httpx.TimeoutException as err:
            raise NotReachable(f"{self.url} did not answer in time; is the service busy or away?") from err
        except httpx.TransportError as err:
            raise NotReachable(f"Nobody answers at {self.url} ({err}); `sldr serve` starts the service.") from err

    def _read(self, kind: type[Record], answer: httpx.Response, part: str | None) -> Record:
        if kind is type(None):
            return None  # type: ignore[return-value]
        try:
            content = answer.json()
            return TypeAdapter(kind).validate_python(content if part is None else content[part])
        except (ValueError, KeyError, TypeError, ValidationError) as err:
            raise BadAnswer(
                f"{self.url} answers otherwise than this client expects; is it an SLDR service, and of this version?"
            ) from err


def _check(answer: httpx.Response) -> None:
    """Raise what an answer has refused."""
    if answer.is_success:
        return
    try:
        problems = tuple(Problem(problem["field"], problem["message"]) for problem in answer.json()["problems"])
    except (ValueError, KeyError, TypeError):
        problems = ()
    if not problems:
        message = f"{answer.request.url} answers with {answer.status_code} and no sentence; is it an SLDR service?"
        problems = (Problem(None, message),)
    raise error_for(answer.status_code, problems)

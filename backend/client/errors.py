"""The errors of the client, each one sentence, most of them the service's own.

ClientError
├── NotReachable         nobody answers at the address, or no service of this product does
├── NotAllowed           a token is missing, wrong or not good for this (401, 403)
├── NotThere             there is no such run, study or file (404)
├── Refused              its state does not allow this (409)
├── Unfit                a field or setting cannot work (400, 413, 422); `problems` names each
├── ServerFailed         the service itself failed, or its store is away (5xx)
├── BadAnswer            what came is not what the service says: damaged, or of another version
└── StillGoing           what was waited for has not ended in time
"""

from __future__ import annotations

from dataclasses import dataclass

from sldr_core.errors import SldrError


@dataclass(frozen=True)
class Problem:
    """One thing wrong with a request."""

    field: str | None
    """Dotted name of the field or setting at fault, if there is one."""
    message: str


class ClientError(SldrError):
    """Be the root of the client's errors."""


class NotReachable(ClientError):
    """Report an address at which nobody answers."""


class Answered(ClientError):
    """Report what the service has refused to do."""

    def __init__(self, problems: tuple[Problem, ...]) -> None:
        super().__init__("; ".join(_sentence(problem) for problem in problems))
        self.problems = problems


class NotAllowed(Answered):
    """Report a token that is missing, wrong or not good for this."""


class NotThere(Answered):
    """Report a run, study or file that does not exist."""


class Refused(Answered):
    """Report what the present state does not allow."""


class Unfit(Answered):
    """Report fields or settings that cannot work."""


class ServerFailed(Answered):
    """Report a fault of the service, or that its store is away."""


class BadAnswer(ClientError):
    """Report an answer that is not what it should be."""


class StillGoing(ClientError):
    """Report what has not ended in the time it was given."""


def error_for(status: int, problems: tuple[Problem, ...]) -> Answered:
    """Return the error that an answer of this status stands for."""
    kinds = {401: NotAllowed, 403: NotAllowed, 404: NotThere, 409: Refused}
    return kinds.get(status, ServerFailed if status >= 500 else Unfit)(problems)


def _sentence(problem: Problem) -> str:
    return problem.message if problem.field is None else f"{problem.field}: {problem.message}"

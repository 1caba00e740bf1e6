"""Many processes at one store: workers that log much, APIs that are asked much; nobody may be locked out."""

from __future__ import annotations

import random
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

import httpx
from chaos_service import HERE, Service, make_service, running
from chaos_table import Finding

from backend.store.access.local_token import load_local_token
from backend.store.database import open_database
from backend.store.runs import RunFilter, list_runs
from backend.store.settings import Settings
from backend.store.states import RunState

LOCKED = "database is locked"
RUNS_PER_LAUNCH = 4
LAUNCH_S = 1.0
"""Between two launches [s]."""
START_PATIENCE_S = 120.0
ANSWER_PATIENCE_S = 60.0
"""How long an answer may take [s]."""


@dataclass(frozen=True)
class Crowd:
    """Say how many press how long."""

    seconds: float
    apis: int
    workers: int
    clients: int
    seed: int
    cycles: int = 200
    cycle_s: float = 0.02


@dataclass
class Answers:
    """Count what the APIs have answered."""

    by_status: Counter[int] = field(default_factory=Counter[int])
    longest_s: float = 0.0
    unanswered: list[str] = field(default_factory=list)
    lock: threading.Lock = field(default_factory=threading.Lock)

    def note(self, status: int, took_s: float) -> None:
        """Count one answer."""
        with self.lock:
            self.by_status[status] += 1
            self.longest_s = max(self.longest_s, took_s)


def press(settings: Settings, order: Crowd, say: Callable[[str], None]) -> Finding:
    """Let everybody at the store, and count who was turned away."""
    child = [sys.executable, str(HERE / "chaos_training.py"), str(order.cycles), str(order.cycle_s)]
    db = open_database(settings)
    service = make_service(settings, order.workers, order.apis, 60.0, child, slots=2)
    answers = Answers()
    with running(service):
        _wait_for_apis(service)
        say(f"{order.apis} APIs and {order.workers} workers at {settings.database_url} for {order.seconds:.0f} s")
        _ask_for(order, service, answers)
    ended = list_runs(db, RunFilter(states=[RunState.SUCCEEDED]), 1).total
    db.close()
    locked = service.logs().count(LOCKED)
    found = [f"'{LOCKED}' was printed {locked} times."] if locked else []
    found += [f"{count} answers had status {status}." for status, count in answers.by_status.items() if status >= 500]
    found += [f"A request was not answered: {error}" for error in answers.unanswered]
    if restarts := sum(kept.starts - 1 for kept in (*service.workers, *service.apis)):
        found.append(f"Processes died {restarts} times.")
    if not ended:
        found.append("No run has succeeded, so nothing was shown.")
    return Finding(
        name="A crowd at one store",
        rows=[
            ("store", settings.database_url.partition(":")[0]),
            ("APIs, workers, clients", f"{order.apis}, {order.workers}, {order.clients}"),
            ("time", f"{order.seconds:.0f} s"),
            ("answers", str(sum(answers.by_status.values()))),
            ("longest answer", f"{answers.longest_s:.2f} s"),
            ("runs that have succeeded", str(ended)),
            (f"'{LOCKED}'", str(locked)),
        ],
        complaints=found,
    )


def _wait_for_apis(service: Service) -> None:
    give_up_at = time.monotonic() + START_PATIENCE_S
    for address in service.addresses:
        while True:
            service.keep_alive()
            try:
                if httpx.get(f"{address}/healthz", trust_env=False).status_code == 200:
                    break
            except httpx.HTTPError:
                pass
            if time.monotonic() > give_up_at:
                raise SystemExit(f"The API at {address} did not answer for {START_PATIENCE_S:.0f} s.")
            time.sleep(0.2)


def _ask_for(order: Crowd, service: Service, answers: Answers) -> None:
    """Let clients ask for as long as the order says, and launch runs."""
    until = time.monotonic() + order.seconds
    clients = [
        threading.Thread(target=_ask, args=(random.Random(order.seed + number), service, answers, until))
        for number in range(order.clients)
    ]
    for client in clients:
        client.start()
    seeds = iter(range(10**9))
    with httpx.Client(trust_env=False, timeout=ANSWER_PATIENCE_S, headers=_token_header(service)) as client:
        while time.monotonic() < until:
            service.keep_alive()
            wanted = {"task": "FetchPush", "method": "her", "preset": "smoke"}
            body = {**wanted, "seeds": [next(seeds) for _ in range(RUNS_PER_LAUNCH)]}
            _count(client, answers, "POST", f"{service.addresses[0]}/api/launches", body)
            time.sleep(LAUNCH_S)
    for client in clients:
        client.join()


def _ask(drawn: random.Random, service: Service, answers: Answers, until: float) -> None:
    """Do what pages do: look at the table, at a run, its curves and history; now and then cancel one."""
    with httpx.Client(trust_env=False, timeout=ANSWER_PATIENCE_S, headers=_token_header(service)) as client:
        while time.monotonic() < until:
            address = drawn.choice(service.addresses)
            page = _count(client, answers, "GET", f"{address}/api/runs")
            _count(client, answers, "GET", f"{address}/api/workers")
            runs = page["runs"] if page else []
            if runs:
                run = f"{address}/api/runs/{drawn.choice(runs)['id']}"
                for part in ("", "/metrics", "/events"):
                    _count(client, answers, "GET", run + part)
                if drawn.random() < 0.05:
                    _count(client, answers, "POST", run + "/cancel")


def _token_header(service: Service) -> dict[str, str]:
    return {"Authorization": f"Bearer {load_local_token(service.settings)}"}


def _count(client: httpx.Client, answers: Answers, method: str, url: str, body: object = None) -> dict | None:
    started = time.monotonic()
    try:
        answer = client.request(method, url, json=body)
    except httpx.HTTPError as err:
        answers.unanswered.append(f"{method} {url}: {err!r}")
        return None
    answers.note(answer.status_code, time.monotonic() - started)
    return answer.json() if answer.status_code == 200 else None

"""`sldr doctor`: what works here, what does not, and how to mend it."""

from __future__ import annotations

import dataclasses
import json as json_format
from collections.abc import Iterator, Sequence

import tyro

from backend.store.settings import Settings, load_settings
from worker.doctor.data import look_at_files, look_at_home, look_at_store, look_at_workers
from worker.doctor.finding import Finding, guard
from worker.doctor.installation import look_at_page, look_at_versions
from worker.doctor.machine import look_at_disk, look_at_gpu, look_at_port, look_at_renderer

MARKS = {"ok": "ok", "poor": "poor", "wrong": "WRONG"}
SOMETHING_WRONG = 1
"""Exit code when something keeps the service from working."""


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(doctor, prog="sldr doctor", args=list(arguments))


def doctor(host: str = "127.0.0.1", port: int = 8000, json: bool = False) -> int:
    """Look at everything that the service needs; the exit code is 1 if something keeps it from working.

    Args:
        host: The address that the service would listen on.
        port: The port that it would listen on.
        json: Print the findings for programs.
    """
    findings: list[Finding] = []
    for finding in look(load_settings(), host, port):
        findings.append(finding)
        if not json:
            print("\n".join(lines_of(finding)), flush=True)
    if json:
        print(json_format.dumps([dataclasses.asdict(finding) for finding in findings], indent=2))
    return SOMETHING_WRONG if any(finding.standing == "wrong" for finding in findings) else 0


def look(settings: Settings, host: str, port: int) -> Iterator[Finding]:
    """Yield what is found, as soon as it is; nothing is changed."""
    yield guard("versions", look_at_versions)
    yield guard("page", look_at_page)
    home = guard("data", lambda: look_at_home(settings.home))
    yield home
    yield guard("disk", lambda: look_at_disk(settings.home))
    store = guard("store", lambda: look_at_store(settings))
    yield store
    yield guard("files", lambda: look_at_files(settings))
    if home.standing != "wrong" and store.standing == "ok":
        yield guard("workers", lambda: look_at_workers(settings))
    yield guard("port", lambda: look_at_port(host, port))
    yield guard("GPU", look_at_gpu)
    yield guard("drawing", look_at_renderer)


def lines_of(finding: Finding) -> list[str]:
    """Return what a person reads of a finding."""
    told = f"{MARKS[finding.standing]:6} {finding.name:9} {finding.told}"
    return [told, f"{'':16} To mend it: {finding.mend}"] if finding.mend else [told]

"""The compose file and the Dockerfile: valid, closed to other machines, and made of what there is."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml
from dockerfile import build, context_files, read_dockerfile

from worker.cli import COMMANDS

ROOT = Path(__file__).parents[2]
COMPOSE_FILE = ROOT / "docker-compose.yml"
COMPOSE: dict[str, Any] = yaml.safe_load(COMPOSE_FILE.read_text())
SERVICES: dict[str, dict[str, Any]] = COMPOSE["services"]
INSTRUCTIONS = read_dockerfile(ROOT / "Dockerfile")
RUNS = [instruction.rest for instruction in INSTRUCTIONS if instruction.name == "RUN"]
TIMEOUT_S = 60


def test_the_compose_file_is_valid() -> None:
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", "vendor.compose-spec", COMPOSE_FILE]
    done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)

    assert done.returncode == 0, done.stdout


def test_a_compose_file_that_is_not_valid_is_found_out(tmp_path: Path) -> None:
    broken = tmp_path / "docker-compose.yml"
    broken.write_text(COMPOSE_FILE.read_text().replace("healthcheck:", "healthchecks:"))
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", "vendor.compose-spec", broken]
    done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)

    assert "healthchecks" in done.stdout


def test_no_port_is_open_to_other_machines() -> None:
    ports = {name: service["ports"] for name, service in SERVICES.items() if "ports" in service}

    assert ports == {"backend": ["127.0.0.1:${SLDR_PORT:-8000}:8000"]}
    assert COMPOSE["networks"]["inside"] == {"internal": True}


@pytest.mark.parametrize("name", SERVICES)
def test_every_service_is_watched_and_started_again(name: str) -> None:
    assert {"test", "interval", "timeout", "retries"} <= SERVICES[name]["healthcheck"].keys()
    assert SERVICES[name]["restart"] == "unless-stopped"


def test_every_volume_is_kept_by_name() -> None:
    used = {volume.partition(":")[0] for service in SERVICES.values() for volume in service["volumes"]}

    assert used == set(COMPOSE["volumes"])


@pytest.mark.parametrize("name", ["backend", "worker"])
def test_services_are_commands_of_ours_with_options_that_exist(name: str) -> None:
    program, command, *arguments = SERVICES[name]["command"]
    offered = subprocess.run(
        [sys.executable, "-m", "worker.cli", command, "--help"],
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=True,
    ).stdout

    assert program == "sldr"
    assert [word for word in arguments if word.startswith("--") and word not in offered] == []


def test_backend_and_worker_share_store_and_files() -> None:
    backend, worker = SERVICES["backend"], SERVICES["worker"]

    assert worker["environment"].items() <= backend["environment"].items()
    assert backend["volumes"] == worker["volumes"] == [f"files:{backend['environment']['SLDR_HOME']}"]


def test_the_steps_of_the_image_are_those_of_make() -> None:
    targets = [shlex.split(step)[1:] for step in RUNS if step.startswith("make ")]
    dry = subprocess.run(
        ["make", "--dry-run", "--always-make", *(target for step in targets for target in step)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=False,
    )

    assert targets[-1] == ["setup"]
    assert dry.returncode == 0, dry.stderr
    assert [step for step in RUNS if not step.startswith(("make ", "apt-get ", "mkdir "))] == []


def test_the_image_is_made_of_files_that_are_there_and_of_none_that_git_ignores() -> None:
    files = set(context_files(ROOT))
    sources = [word for step in INSTRUCTIONS if step.name == "COPY" for word in shlex.split(step.rest)[:-1]]
    tracked = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split(
        "\n"
    )
    ignored = subprocess.run(
        ["git", "check-ignore", "--stdin"], cwd=ROOT, input="\n".join(map(str, files)), capture_output=True, text=True
    ).stdout

    assert [source for source in sources if not (ROOT / source).exists()] == []
    assert {Path(name) for name in tracked if name} <= files
    assert ignored == ""


def test_the_image_serves_the_page_from_the_place_of_the_volume() -> None:
    last = {step.name: step.rest for step in INSTRUCTIONS}

    assert yaml.safe_load(last["CMD"])[:2] == ["sldr", "serve"]
    assert "serve" in COMMANDS
    assert f"SLDR_HOME={SERVICES['worker']['environment']['SLDR_HOME']}" in last["ENV"]


@pytest.mark.slow
def test_the_image_is_built_and_its_command_runs(tmp_path: Path) -> None:
    build(ROOT, tmp_path)
    sldr = tmp_path / "app" / ".venv" / "bin" / "sldr"
    tasks = subprocess.run(
        [sldr, "list", "tasks"], cwd="/", env={"HOME": os.environ["HOME"]}, capture_output=True, text=True, check=True
    )

    assert "FetchPush" in tasks.stdout
    assert (tmp_path / "app" / "web" / "dist" / "index.html").is_file()
    assert (tmp_path / "data").stat().st_mode & 0o777 == 0o777

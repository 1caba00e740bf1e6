"""What a person is told on a machine where something is missing, tried with a PATH of fake programs."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

CI = Path(__file__).parents[2] / ".ci"
TIMEOUT_S = 20

NEW_PYTHON = 'case "$2" in *version_info*) echo 3.11;; esac'
OLD_PYTHON = 'case "$2" in *version_info*) echo 3.9;; esac'
PYTHON_WITHOUT_VENV = 'case "$2" in *version_info*) echo 3.11;; *) exit 1;; esac'
EVERY_PACKAGE = "echo installed"
NO_PACKAGE = "exit 1"
STUB = 'echo "requires the chromium snap to be installed" >&2; exit 1'


class Machine:
    """A directory of fake programs that is the whole PATH of the scripts."""

    def __init__(self, root: Path) -> None:
        self.bin = root / "bin"
        self.bin.mkdir()
        self.calls = root / "calls"
        self.os_release = root / "os-release"
        self.os_release.write_text("ID=debian\n")
        self.debian_postgres = root / "postgresql"
        for name in ("bash", "env"):
            (self.bin / name).symlink_to(shutil.which(name) or name)
        self.install("python3", NEW_PYTHON)
        self.install("node", "echo v20.20.2")
        self.install("npm", "echo 11.0.0")
        self.install("chromium", "echo Chromium 150")
        self.install("initdb", "exit 1")
        self.install("postgres", "exit 1")
        self.install("dpkg-query", EVERY_PACKAGE)
        self.install("apt-get", f'echo "$*" >>{self.calls}')
        self.install("id", "echo 1000")

    def install(self, name: str, body: str) -> None:
        program = self.bin / name
        program.write_text(f"#!/bin/bash\n{body}\n")
        program.chmod(0o755)

    def remove(self, name: str) -> None:
        (self.bin / name).unlink()

    def run(self, script: str, *arguments: str, **settings: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            ["/bin/bash", CI / script, *arguments],
            env={
                "PATH": str(self.bin),
                "OS_RELEASE": str(self.os_release),
                "POSTGRES_ROOT": str(self.debian_postgres),
                **settings,
            },
            capture_output=True,
            text=True,
            timeout=TIMEOUT_S,
            check=False,
        )

    def apt_calls(self) -> list[str]:
        return self.calls.read_text().splitlines() if self.calls.exists() else []


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    return Machine(tmp_path)


@pytest.mark.parametrize("purpose", ["run", "test"])
def test_a_complete_machine_passes_without_a_word(machine: Machine, purpose: str) -> None:
    result = machine.run("system-packages.sh", purpose)

    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")
    assert machine.apt_calls() == []


def test_no_node_gets_one_sentence(machine: Machine) -> None:
    machine.remove("node")

    result = machine.run("system-packages.sh", "run")

    assert result.returncode == 1
    assert result.stderr == (
        "Node.js 20.19 or newer is needed, and there is none: install it from https://nodejs.org and run make again.\n"
    )


@pytest.mark.parametrize("version", ["v18.19.0", "v20.18.3"])
def test_an_old_node_is_named_with_its_version(machine: Machine, version: str) -> None:
    machine.install("node", f"echo {version}")

    result = machine.run("system-packages.sh", "run")

    assert result.returncode == 1
    assert f"this one is {version[1:]}: install a newer one" in result.stderr
    assert result.stderr.count("\n") == 1


@pytest.mark.parametrize("version", ["v20.19.0", "v22.1.0", "v24.0.0"])
def test_a_new_node_passes(machine: Machine, version: str) -> None:
    machine.install("node", f"echo {version}")

    assert machine.run("system-packages.sh", "run").returncode == 0


def test_an_old_python_is_named_with_its_version(machine: Machine) -> None:
    machine.install("python3", OLD_PYTHON)

    result = machine.run("system-packages.sh", "run")

    assert result.returncode == 1
    assert "Python 3.11 or newer is needed, but python3 is 3.9: install it" in result.stderr


def test_no_python_gets_one_sentence(machine: Machine) -> None:
    machine.remove("python3")

    result = machine.run("system-packages.sh", "run")

    assert result.returncode == 1
    assert result.stderr.startswith("Python 3.11 or newer is needed, but none of python3 ")


def test_a_newer_python_beside_an_old_one_is_found(machine: Machine) -> None:
    machine.install("python3", OLD_PYTHON)
    machine.install("python3.12", NEW_PYTHON)

    assert machine.run("find-python.sh").stdout == "python3.12\n"


def test_the_python_that_is_named_is_used(machine: Machine) -> None:
    machine.install("mine", NEW_PYTHON)

    assert machine.run("find-python.sh", PYTHON="mine").stdout == "mine\n"


def test_everything_missing_is_said_at_once(machine: Machine) -> None:
    machine.remove("node")
    machine.install("python3", OLD_PYTHON)

    result = machine.run("system-packages.sh", "run")

    assert "Python 3.11" in result.stderr
    assert "Node.js 20.19" in result.stderr


def test_without_root_the_exact_command_is_named(machine: Machine) -> None:
    machine.install("python3", PYTHON_WITHOUT_VENV)
    machine.remove("npm")

    result = machine.run("system-packages.sh", "run")

    assert result.returncode == 1
    assert result.stderr == (
        "System packages are missing; install them with: sudo apt-get install -y python3-venv npm\n"
    )
    assert machine.apt_calls() == []


def test_without_root_missing_rendering_is_a_warning_for_running(machine: Machine) -> None:
    machine.install("dpkg-query", NO_PACKAGE)

    result = machine.run("system-packages.sh", "run")

    assert result.returncode == 0
    assert result.stderr == (
        "Tasks will have no pictures; to see them: sudo apt-get install -y libegl1 libegl-mesa0 libgl1-mesa-dri\n"
    )


def test_without_root_missing_rendering_stops_the_tests(machine: Machine) -> None:
    machine.install("dpkg-query", NO_PACKAGE)

    result = machine.run("system-packages.sh", "test")

    assert result.returncode == 1
    assert "sudo apt-get install -y libegl1 libegl-mesa0 libgl1-mesa-dri" in result.stderr


def test_root_installs_what_is_missing_in_one_call(machine: Machine) -> None:
    machine.install("id", "echo 0")
    machine.install("dpkg-query", NO_PACKAGE)
    machine.install("python3", PYTHON_WITHOUT_VENV)

    result = machine.run("system-packages.sh", "run")

    assert result.returncode == 0
    assert machine.apt_calls() == [
        "update -qq",
        "install -y -qq python3-venv libegl1 libegl-mesa0 libgl1-mesa-dri",
    ]


def test_root_is_told_when_the_installation_fails(machine: Machine) -> None:
    machine.install("id", "echo 0")
    machine.install("apt-get", "exit 100")
    machine.remove("npm")

    result = machine.run("system-packages.sh", "run")

    assert result.returncode == 1
    assert "install them with: sudo apt-get install -y npm" in result.stderr


def test_a_system_without_apt_can_still_run(machine: Machine) -> None:
    machine.remove("apt-get")
    machine.remove("dpkg-query")

    assert machine.run("system-packages.sh", "run").returncode == 0


def test_running_needs_no_browser(machine: Machine) -> None:
    machine.remove("chromium")

    assert machine.run("system-packages.sh", "run").returncode == 0


def test_the_tests_ask_debian_for_chromium(machine: Machine) -> None:
    machine.remove("chromium")

    result = machine.run("system-packages.sh", "test")

    assert result.returncode == 1
    assert "sudo apt-get install -y chromium" in result.stderr


def test_the_stub_of_ubuntu_is_no_browser(machine: Machine) -> None:
    machine.os_release.write_text("ID=ubuntu\n")
    machine.install("id", "echo 0")
    machine.install("chromium", STUB)

    result = machine.run("system-packages.sh", "test")

    assert result.returncode == 1
    assert "name it with SLDR_CHROMIUM=/path/to/it" in result.stderr
    assert machine.apt_calls() == []


@pytest.mark.parametrize("name", ["chromium-browser", "google-chrome", "google-chrome-stable"])
def test_any_chromium_will_do(machine: Machine, name: str) -> None:
    machine.install("chromium", STUB)
    machine.install(name, "echo Chromium 150")

    assert machine.run("find-chromium.sh").stdout == f"{machine.bin / name}\n"


def test_the_browser_that_is_named_is_used(machine: Machine) -> None:
    machine.install("mine", "echo Chromium 150")

    assert machine.run("find-chromium.sh", SLDR_CHROMIUM="mine").stdout == f"{machine.bin / 'mine'}\n"


def test_running_needs_no_postgresql(machine: Machine) -> None:
    machine.remove("postgres")

    assert machine.run("system-packages.sh", "run").returncode == 0


def test_the_tests_ask_for_postgresql(machine: Machine) -> None:
    machine.remove("postgres")

    result = machine.run("system-packages.sh", "test")

    assert result.returncode == 1
    assert "sudo apt-get install -y postgresql" in result.stderr


def test_the_postgresql_of_debian_is_found_outside_the_path(machine: Machine) -> None:
    programs = machine.debian_postgres / "15" / "bin"
    programs.mkdir(parents=True)
    for name in ("initdb", "postgres"):
        (machine.bin / name).rename(programs / name)

    assert machine.run("find-postgres.sh").stdout == f"{programs}\n"


def test_no_postgresql_gets_one_sentence(machine: Machine) -> None:
    machine.remove("initdb")

    result = machine.run("find-postgres.sh")

    assert result.returncode == 1
    assert result.stderr.count("\n") == 1
    assert "install them with: sudo apt-get install -y postgresql" in result.stderr

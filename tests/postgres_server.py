"""A PostgreSQL server that the tests start themselves, on 127.0.0.1 and a free port."""

from __future__ import annotations

import ctypes
import os
import pwd
import secrets
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from itertools import count
from pathlib import Path

import psycopg
import pytest

FIND = Path(__file__).parents[1] / ".ci" / "find-postgres.sh"
USER = "sldr"
OURS = "tests"
"""What our own connections call themselves, which stay open."""
PATIENCE_S = 60.0
PARTING_S = 1.0
"""How long connections may take to end before their database is given up [s]."""
SETTINGS = {
    "listen_addresses": "127.0.0.1",
    "fsync": "off",  # what a test writes need not outlive the machine
    "full_page_writes": "off",
    "autovacuum": "off",
    "shared_buffers": "32MB",
    "max_connections": "200",
}
PR_SET_PDEATHSIG = 1


class PostgresServer:
    """One server with a data directory of its own; `stop` and `start` may be called again and again."""

    def __init__(self) -> None:
        self._programs = _find_programs()
        self._account = _account()
        # Not below pytest's own directory, which other accounts than ours cannot enter.
        self._directory = Path(tempfile.mkdtemp(prefix="sldr-postgres-"))
        if self._account.pw_uid != os.getuid():
            os.chown(self._directory, self._account.pw_uid, self._account.pw_gid)
        self._process: subprocess.Popen[bytes] | None = None
        self._numbers = count()
        self._connections: dict[str, psycopg.Connection] = {}
        self._password = secrets.token_hex()
        password = self._directory / "password.txt"
        password.write_text(self._password)
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self._port: int = probe.getsockname()[1]
        arguments = [
            "--pgdata=data",
            f"--username={USER}",
            "--auth=password",
            f"--pwfile={password}",
            "--no-sync",
            "--encoding=UTF8",
            "--locale=C",
        ]
        initdb = self._begin([self._programs / "initdb", *arguments])
        assert initdb.wait() == 0, self._log()

    def url(self, name: str) -> str:
        """Return the address of one of its databases, as `SLDR_DATABASE_URL` has it."""
        return f"postgresql+psycopg://{USER}:{self._password}@127.0.0.1:{self._port}/{name}"

    def start(self) -> None:
        """Start the server and wait until it answers."""
        settings = [word for name, value in SETTINGS.items() for word in ("-c", f"{name}={value}")]
        command = [self._programs / "postgres", "-D", "data", "-k", self._directory, "-p", str(self._port), *settings]
        self._process = self._begin(command)
        give_up_at = time.monotonic() + PATIENCE_S
        while True:
            try:
                self._connected()
                return
            except psycopg.OperationalError:
                assert self._process.poll() is None, self._log()
                assert time.monotonic() < give_up_at, self._log()
                time.sleep(0.02)

    def stop(self, by: signal.Signals = signal.SIGINT) -> None:
        """End the server, whoever is connected: in good order, or with SIGQUIT as if it crashed."""
        assert self._process is not None
        for name in list(self._connections):
            self._connections.pop(name).close()
        self._process.send_signal(by)
        self._process.wait(PATIENCE_S)

    def create_database(self, template: str = "template0") -> str:
        """Make a database that is like another one; return its name."""
        name = f"test_{next(self._numbers)}"
        self._execute(f"CREATE DATABASE {name} TEMPLATE {template} STRATEGY file_copy")
        return name

    def drop_database(self, name: str) -> None:
        """Remove a database, whoever is still connected to it."""
        if name in self._connections:
            self._connections.pop(name).close()
        self._execute(f"DROP DATABASE {name} WITH (FORCE)")

    def empty_database(self, name: str, revision: str) -> bool:
        """Remove every row of a store; tell if it is as good as new, with tables of this revision and nobody on it."""
        if not self._is_left_alone(name):
            return False
        connection = self._connected(name)
        if connection.execute("SELECT version_num FROM alembic_version").fetchall() != [(revision,)]:
            return False
        tables = "SELECT tablename FROM pg_tables WHERE schemaname = 'public' AND tablename <> 'alembic_version'"
        names = [row[0] for row in connection.execute(tables)]
        held = " UNION ALL ".join(f"SELECT '{table}' WHERE EXISTS (SELECT FROM {table})" for table in names)
        filled = [row[0] for row in connection.execute(held.encode())]
        connection.execute("SET session_replication_role = replica")  # rows may go in any order
        for table in filled:
            connection.execute(f"DELETE FROM {table}".encode())
        connection.execute(
            "SELECT setval(format('%I', sequencename)::regclass, start_value, false) "
            "FROM pg_sequences WHERE last_value IS NOT NULL"
        )
        return True

    def _is_left_alone(self, name: str) -> bool:
        """Wait a little for connections other than ours to end; tell if none is left."""
        others = "SELECT 1 FROM pg_stat_activity WHERE datname = %s AND application_name <> %s"
        connection = self._connected(name)
        give_up_at = time.monotonic() + PARTING_S
        while connection.execute(others, [name, OURS]).fetchone():
            if time.monotonic() > give_up_at:
                return False
            time.sleep(0.005)
        return True

    def remove(self) -> None:
        """Remove everything the server has written."""
        shutil.rmtree(self._directory)

    def _begin(self, command: list[str | Path]) -> subprocess.Popen[bytes]:
        """Start a program under the account; it ends with this process."""
        other = self._account.pw_uid != os.getuid()
        with (self._directory / "log.txt").open("ab") as log:
            return subprocess.Popen(
                command,
                cwd=self._directory,
                stdout=log,
                stderr=log,
                user=self._account.pw_uid if other else None,
                group=self._account.pw_gid if other else None,
                extra_groups=[] if other else None,
                preexec_fn=_end_with_parent,
            )

    def _log(self) -> str:
        return (self._directory / "log.txt").read_text()

    def _execute(self, statement: str) -> None:
        self._connected().execute(statement.encode())

    def _connected(self, name: str = "postgres") -> psycopg.Connection:
        """Return our connection to a database, which stays open: to make one takes longer than what it is asked."""
        if name not in self._connections:
            address = {"host": "127.0.0.1", "port": self._port, "user": USER, "password": self._password}
            self._connections[name] = psycopg.connect(**address, dbname=name, autocommit=True, application_name=OURS)
        return self._connections[name]


def _find_programs() -> Path:
    found = subprocess.run([FIND], capture_output=True, text=True)
    if found.returncode != 0:
        pytest.fail(found.stderr, pytrace=False)
    return Path(found.stdout.strip())


def _account() -> pwd.struct_passwd:
    """Return the account to start PostgreSQL under: our own, unless that is root, as which it refuses to run."""
    if os.getuid() != 0:
        return pwd.getpwuid(os.getuid())
    installed = any(entry.pw_name == "postgres" for entry in pwd.getpwall())
    return pwd.getpwnam("postgres" if installed else "nobody")


def _end_with_parent() -> None:
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGQUIT)

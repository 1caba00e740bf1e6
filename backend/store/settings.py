"""Where the service keeps its data: read once from the environment, then passed around."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

HOME_VARIABLE = "SLDR_HOME"
DATABASE_VARIABLE = "SLDR_DATABASE_URL"
FILES_VARIABLE = "SLDR_FILES_URL"
LOCAL_WEBHOOKS_VARIABLE = "SLDR_LOCAL_WEBHOOKS"
"""Set to `allow`, webhooks may go to services on this machine."""
ALLOW = "allow"
DEFAULT_HOME = "~/.sldr"


@dataclass(frozen=True)
class Settings:
    """Say where files and tables lie."""

    home: Path
    """The one directory below which this machine writes."""
    database_url: str
    """SQLAlchemy address of the store."""
    files_url: str | None = None
    """The place that several machines share files through, as fsspec names it; None if `home` is all there is."""
    local_webhooks: bool = False
    """Whether webhooks may go to services on this machine."""

    @property
    def runs_directory(self) -> Path:
        """The directory that holds one directory a run."""
        return self.home / "runs"

    @property
    def pictures_directory(self) -> Path:
        """The rendered pictures of the tasks."""
        return self.home / "pictures"

    @property
    def logs_directory(self) -> Path:
        """The logs of the service's own processes."""
        return self.home / "logs"

    @property
    def fetched_directory(self) -> Path:
        """Copies of files that other machines have written; it can be emptied at any time."""
        return self.home / "fetched"

    @property
    def known_place_file(self) -> Path:
        """Which shared directory this machine has used, so that it is missed when it is not mounted."""
        return self.home / "files-place"

    @property
    def secret_path(self) -> Path:
        """The key that signs viewer tokens."""
        return self.home / "secret"

    @property
    def server_file(self) -> Path:
        """The address of the service that runs over this directory, which locks the file meanwhile."""
        return self.home / "server-address"

    @property
    def access_token_path(self) -> Path:
        """The token that opens a server on loopback."""
        return self.home / "access-token"

    def run_directory(self, run_id: str) -> Path:
        """Return the directory of one run; it exists once a worker has begun the run."""
        return self.runs_directory / run_id

    def as_environment(self) -> dict[str, str]:
        """Return the environment variables that give a child process the same settings."""
        shared = {} if self.files_url is None else {FILES_VARIABLE: self.files_url}
        local = {LOCAL_WEBHOOKS_VARIABLE: ALLOW} if self.local_webhooks else {}
        return {HOME_VARIABLE: str(self.home), DATABASE_VARIABLE: self.database_url, **shared, **local}


def load_settings() -> Settings:
    """Read the settings from the environment."""
    home = Path(os.environ.get(HOME_VARIABLE) or DEFAULT_HOME).expanduser().absolute()
    return Settings(
        home=home,
        database_url=os.environ.get(DATABASE_VARIABLE) or sqlite_url(home),
        files_url=os.environ.get(FILES_VARIABLE) or None,
        local_webhooks=os.environ.get(LOCAL_WEBHOOKS_VARIABLE) == ALLOW,
    )


def sqlite_url(home: Path) -> str:
    """Return the address of the default database below `home`."""
    return f"sqlite:///{home / 'sldr.db'}"

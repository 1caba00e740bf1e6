"""`sldr zoo add`: put locomotion models into the zoo, in half precision, and measure what is shipped."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import tyro

from backend.store.database import open_database
from backend.store.files import find_file
from backend.store.metrics import read_metrics
from backend.store.runs import get_run
from backend.store.settings import load_settings
from backend.store.storage import FileStorage
from backend.store.zoo_runs import LOCOMOTION_FILE
from sldr_core.zoo.index import zoo_directory


@dataclass(frozen=True)
class Trained:
    """A model that shall be added, and what is known of its training."""

    path: Path
    preset: str
    wall_s: float | None


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.extras.subcommand_cli_from_dict({"add": add}, prog="sldr zoo", args=list(arguments))


def add(
    models: tyro.conf.Positional[tuple[str, ...]],
    preset: str = "paper",
    machine: str = "",
    episodes: int = 380,
    directory: Path | None = None,
) -> int:
    """Add models: each is halved, measured over test episodes, and described in the zoo's index.

    Args:
        models: Ids of locomotion runs in the store, or locomotion.pt files.
        preset: The budget that files were trained with; runs know theirs.
        machine: What they were trained on, if that was not this machine.
        episodes: Test episodes to measure each over.
        directory: The zoo, if it is not the product's own.
    """
    # Imported here, because it loads PyTorch.
    from sldr_core.zoo.adding import add_to_zoo, origin_here

    for word in models:
        trained = Trained(Path(word), preset, None) if Path(word).is_file() else _of_run(word)
        origin = origin_here(trained.preset, trained.wall_s, machine)
        model = add_to_zoo(trained.path, directory or zoo_directory(), origin, episodes)
        print(f"{model.name}: {model.measured.success_rate:.1%} of {episodes} episodes, {model.size / 1e3:.0f} kB")
    return 0


def _of_run(run_id: str) -> Trained:
    settings = load_settings()
    with closing(open_database(settings)) as db:
        run = get_run(db, run_id)
        path = FileStorage(settings).bring(find_file(db, run_id, LOCOMOTION_FILE))
        seconds = read_metrics(db, run_id).wall_seconds
    return Trained(path, run.preset, seconds[-1] if seconds else None)

"""Write the OpenAPI schema to a file: `python -m backend.api.schema FILE`.

The TypeScript client is generated from it; equal code gives equal bytes.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from backend.api.app import create_app
from backend.store.settings import Settings, load_settings


def schema_text(settings: Settings) -> str:
    """Return the schema as JSON; it does not depend on the settings' values."""
    return json.dumps(create_app(settings).openapi(), indent=2, sort_keys=True) + "\n"


def main() -> None:
    """Write the schema to the file named on the command line."""
    if len(sys.argv) != 2:
        sys.exit("Say where to write the schema: python -m backend.api.schema FILE")
    path = Path(sys.argv[1])
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(schema_text(load_settings()))


if __name__ == "__main__":
    main()

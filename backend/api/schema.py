"""Write the OpenAPI schema to a file: `python -m backend.api.schema FILE`.

The TypeScript client is generated from it; equal code gives equal bytes.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from backend.api.app import create_app
from backend.store.settings import load_settings


def main() -> None:
    """Write the schema to the file named on the command line."""
    if len(sys.argv) != 2:
        sys.exit("Say where to write the schema: python -m backend.api.schema FILE")
    path = Path(sys.argv[1])
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(create_app(load_settings()).openapi(), indent=2, sort_keys=True) + "\n")


if __name__ == "__main__":
    main()

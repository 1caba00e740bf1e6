"""Serve the API and the page: `python -m backend.api --host 127.0.0.1 --port 8000`."""

from __future__ import annotations

import argparse

import uvicorn

from backend.api.app import create_app
from backend.store.settings import load_settings

LARGEST_MESSAGE = 64 * 1024 * 1024
"""Largest websocket message from a browser, above what Viser takes [bytes]."""

SHUTDOWN_S = 5
"""How long open connections may hold up the end [s]."""


def main() -> None:
    """Serve until told to end."""
    parser = argparse.ArgumentParser(prog="python -m backend.api", description="Serve the API and the page.")
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on")
    parser.add_argument("--port", type=int, default=8000, help="port to listen on")
    arguments = parser.parse_args()
    uvicorn.run(
        create_app(load_settings()),
        host=arguments.host,
        port=arguments.port,
        log_level="warning",
        ws_per_message_deflate=False,
        ws_max_size=LARGEST_MESSAGE,
        timeout_graceful_shutdown=SHUTDOWN_S,
    )


if __name__ == "__main__":
    main()

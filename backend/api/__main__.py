"""Serve the API and the page: `python -m backend.api --host 127.0.0.1 --port 8000`."""

from __future__ import annotations

import argparse

import uvicorn
from fastapi import FastAPI

from backend.api.app import create_app
from backend.api.hosts import load_host_rule
from backend.api.server_mark import local_url, marked
from backend.logs import load_style, start_logging
from backend.store.access.entry import choose_mode
from backend.store.settings import load_settings

LARGEST_MESSAGE = 64 * 1024 * 1024
"""Largest websocket message from a browser, above what Viser takes [bytes]."""

SHUTDOWN_S = 2
"""How long open connections may hold up the end [s]."""


def make_server(app: FastAPI, host: str, port: int) -> uvicorn.Server:
    """Return the server of an application; 3D views want large messages and no compression of what is dense."""
    config = uvicorn.Config(
        app,
        host=host,
        port=port,
        http="h11",  # httptools, which uvicorn prefers where it lies about, lets the head of a request grow for ever
        log_level="warning",
        log_config=None,  # its warnings go where all others of this process go
        ws_per_message_deflate=False,
        ws_max_size=LARGEST_MESSAGE,
        timeout_graceful_shutdown=SHUTDOWN_S,
    )
    return uvicorn.Server(config)


def main() -> None:
    """Serve until told to end."""
    parser = argparse.ArgumentParser(prog="python -m backend.api", description="Serve the API and the page.")
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on")
    parser.add_argument("--port", type=int, default=8000, help="port to listen on")
    parser.add_argument("--accounts", action="store_true", help="ask for accounts on loopback too")
    arguments = parser.parse_args()
    settings = load_settings()
    start_logging("api", settings.logs_directory, load_style())
    mode = choose_mode(arguments.host, arguments.accounts)
    app = create_app(settings, hosts=load_host_rule(arguments.host), mode=mode)
    with marked(settings, local_url(arguments.host, arguments.port)):
        make_server(app, arguments.host, arguments.port).run()


if __name__ == "__main__":
    main()

"""The view over HTTP, to a browser on this machine that was told its address."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from secrets import token_urlsafe
from socketserver import TCPServer
from threading import Thread, active_count
from typing import Any, get_args

from derive.live.admitting import HERE, asked
from derive.live.view import Shown
from derive.render.skin import templates
from derive.sheet.model import Steps

PATIENCE = 15.0  # seconds between signs of life, and for a request to arrive
MOST = 64  # threads that answer at once
STEPS: dict[str, Steps | None] = {"steps": None, **{f"steps/{name}": name for name in get_args(Steps)}}
CLOSED = "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
OWN = "img-src data:; script-src 'self'; style-src 'self'; connect-src 'self'; frame-src 'self'"
FRAME = f"{CLOSED}; {OWN}"
SHEET = (
    "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'self'; "
    "style-src 'unsafe-inline'; img-src data:; font-src data:; sandbox allow-same-origin"
)
FILES = {
    "": ("page.html", "text/html"),
    "page.css": ("page.css", "text/css"),
    "page.js": ("page.js", "text/javascript"),
}
GUARDS = {
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


@contextmanager
def served(shown: Shown, port: int, ask: Callable[[Steps | None], None]) -> Iterator[str]:
    """The view served while this lasts; gives its address. `ask` is told of steps that a reader asks for.
    Raises OSError where the port cannot be had."""
    try:
        server = _Server(port, shown, ask)
    except OSError as error:
        raise OSError(error.errno, error.strerror, f"port {port}") from error
    thread = Thread(target=server.serve_forever, kwargs={"poll_interval": 0.1}, daemon=True)
    thread.start()
    try:
        yield f"http://{server.host}/{server.token}/"
    finally:
        shown.end()
        server.shutdown()
        server.server_close()
        thread.join()


class _Server(ThreadingHTTPServer):
    """Answers each request in a thread of its own, but not more of them than one reader needs."""

    daemon_threads = True
    block_on_close = False
    allow_reuse_address = os.name == "posix"  # elsewhere another program could take the port as well

    def __init__(self, port: int, shown: Shown, ask: Callable[[Steps | None], None]) -> None:
        super().__init__((HERE, port), _Request)
        self.shown = shown
        self.ask = ask
        self.token = token_urlsafe(16)
        self.host = f"{HERE}:{self.server_port}"

    def server_bind(self) -> None:
        """Binds without a look for the name of this machine, which may take seconds."""
        TCPServer.server_bind(self)
        self.server_name, self.server_port = HERE, self.server_address[1]

    def verify_request(self, request: Any, client_address: Any) -> bool:
        """Whether there is room for one more."""
        return active_count() < MOST

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A reader that went away is no fault of ours."""
        if os.environ.get("DERIVE_DEBUG"):
            super().handle_error(request, client_address)


class _Request(BaseHTTPRequestHandler):
    server: _Server
    timeout = PATIENCE

    def do_GET(self) -> None:
        match self._asked():
            case HTTPStatus() as refused:
                self._refuse(refused)
            case "views":
                self._stream()
            case "sheet":
                self._give(self.server.shown.view.page.encode(), "text/html", SHEET)
            case name if name in FILES:
                file, kind = FILES[name]
                self._give(_file(file), kind, FRAME)
            case _:
                self._refuse(HTTPStatus.NOT_FOUND)

    def do_POST(self) -> None:
        match self._asked(writes=True):
            case HTTPStatus() as refused:
                self._refuse(refused)
            case name if name in STEPS:
                self.server.ask(STEPS[name])
                self._give(b"", "text/plain", CLOSED)
            case _:
                self._refuse(HTTPStatus.NOT_FOUND)

    def _asked(self, writes: bool = False) -> str | HTTPStatus:
        return asked(self.path, self.headers, self.server.server_port, self.server.token, writes)

    def _give(self, content: bytes, kind: str, policy: str) -> None:
        self._head(HTTPStatus.OK, kind, policy)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def _refuse(self, status: HTTPStatus) -> None:
        self._head(status, "text/plain", CLOSED)
        self.end_headers()
        self.wfile.write(f"{status.phrase}\n".encode())

    def _head(self, status: HTTPStatus, kind: str, policy: str) -> None:
        self.send_response(status)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        self.send_header("Content-Security-Policy", policy)
        for name, value in GUARDS.items():
            self.send_header(name, value)

    def _stream(self) -> None:
        """Every view from now on, as an event; a sign of life where nothing happens."""
        self._head(HTTPStatus.OK, "text/event-stream", CLOSED)
        self.end_headers()
        shown, number = self.server.shown, -1
        while not shown.ended:
            view = shown.after(number, PATIENCE / 2)
            number = view.number if view else number
            data = f"data: {json.dumps(view.told())}" if view else ":"
            self.wfile.write(f"{data}\n\n".encode())

    def version_string(self) -> str:
        """Who answers, without versions."""
        return "derive"

    def log_message(self, format: str, *args: Any) -> None:
        """Nothing: the terminal is for the sheet."""


@cache
def _file(name: str) -> bytes:
    return (templates() / "live" / name).read_bytes()

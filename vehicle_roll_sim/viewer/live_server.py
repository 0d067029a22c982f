"""A server on this machine for the page that follows a running simulator, and for its updates."""

import errno
import http.server
import threading
from http import HTTPStatus

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.viewer.live_run import LiveRun

HOST = "127.0.0.1"
"""Only this machine can connect."""
PORTS = (1024, 65535)
DEFAULT_PORT = 8787
FEED = "/updates"
WAITING = """<!DOCTYPE html>
<html lang="en"><meta charset="utf-8"><meta http-equiv="refresh" content="1">
<link rel="icon" href="data:,">
<title>waiting</title>
<p>Waiting for a simulator: no complete set of messages has arrived yet.</p></html>
"""


class LiveServer(http.server.ThreadingHTTPServer):
    """Serves the page of `run` at `address` from a thread of its own, from `start` to `close`.

    run may be replaced by that of another vehicle, or be None: none is known yet. Raises InputError
    naming --port if the port is taken.
    """

    daemon_threads = True
    block_on_close = False

    def __init__(self, port: int):
        try:
            super().__init__((HOST, port), _Answer)
        except OSError as error:
            why = "is taken" if error.errno == errno.EADDRINUSE else f"failed ({error.strerror})"
            allowed = f"a free port from {PORTS[0]} to {PORTS[1]}, or 0 for any"
            raise InputError("--port", port, allowed, f"{port} {why}") from None
        self.run: LiveRun | None = None

    @property
    def address(self) -> str:
        return f"http://{HOST}:{self.server_port}/"

    def start(self) -> None:
        """Serve until `close`."""
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def close(self) -> None:
        """End all updates and the server."""
        if self.run:
            self.run.close()
        self.shutdown()
        self.server_close()


class _Answer(http.server.BaseHTTPRequestHandler):
    """The answer to one request."""

    server: LiveServer

    def do_GET(self) -> None:
        port = self.server.server_port
        if self.headers.get("Host") not in (f"{HOST}:{port}", f"localhost:{port}"):
            self.send_error(HTTPStatus.FORBIDDEN)  # a page from elsewhere under a name of ours
        elif self.path == "/":
            run = self.server.run
            self._send(run.page(FEED) if run and run.window else WAITING)
        elif self.path == FEED and self.server.run:
            self._feed(self.server.run)
        else:
            self.send_error(HTTPStatus.NOT_FOUND)

    def log_message(self, format: str, *values) -> None:
        """Requests are not logged."""

    def _begin(self, kind: str) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", kind)
        self.send_header("Cache-Control", "no-store")
        self.end_headers()

    def _send(self, text: str) -> None:
        self._begin("text/html; charset=utf-8")
        self.wfile.write(text.encode())

    def _feed(self, run: LiveRun) -> None:
        """Server-sent events until the run or the page is closed; empty ones show which it is."""
        self._begin("text/event-stream")
        try:
            for update in run.updates():
                self.wfile.write(f"data: {update}\n\n".encode() if update else b":\n\n")
        except ConnectionError:
            return

"""Delta Lab as a process of its own, started and stopped as a person would."""

from __future__ import annotations

import http.client
import math
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

HOST = "127.0.0.1"
START_TIMEOUT = 30.0
STOP_TIMEOUT = 10.0
CLEAN_EXITS = (0, 130)
DELTALAB = (sys.executable, "-m", "app")


def free_port() -> int:
    """A port nobody listens on at the moment."""
    with socket.socket() as probe:
        probe.bind((HOST, 0))
        return probe.getsockname()[1]


def get(url: str, timeout: float = 5.0) -> tuple[int, str]:
    """Status and body of a page."""
    try:
        with urllib.request.urlopen(url, timeout=timeout) as response:
            return response.status, response.read().decode()
    except urllib.error.HTTPError as refusal:
        return refusal.code, refusal.read().decode()


def _heed_interrupts() -> None:
    """A shell's background job inherits an ignored Ctrl-C, and so would the server."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class RunningServer:
    """A `deltalab` process that listens; its output goes to a file so that no pipe can block it."""

    def __init__(self, *arguments: str, command: Sequence[str] = DELTALAB, cwd: Path | None = None) -> None:
        self.port = free_port()
        self.url = f"http://{HOST}:{self.port}"
        self._output = tempfile.NamedTemporaryFile("w+", suffix=".log")  # noqa: SIM115, discard() closes it
        self.listened_after = math.nan
        """Seconds from the start of the process to its first answer."""
        self._started_at = time.perf_counter()
        self.process = subprocess.Popen(
            [*command, "--no-browser", "--host", HOST, "--port", str(self.port), *arguments],
            stdout=self._output,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            cwd=cwd,
            env={**os.environ, "PYTHONUNBUFFERED": "1"},
            preexec_fn=_heed_interrupts,
        )

    @property
    def pid(self) -> int:
        return self.process.pid

    def output(self) -> str:
        """Everything printed so far, stdout and stderr together."""
        return Path(self._output.name).read_text()

    def wait_for_output(self, text: str) -> str:
        """Wait until `text` was printed; returns all of the output."""
        deadline = time.perf_counter() + START_TIMEOUT
        while text not in self.output() and time.perf_counter() < deadline:
            time.sleep(0.02)
        return self.output()

    def wait_until_listening(self) -> None:
        """Wait for the first answer of `/healthz` and note how long it took."""
        deadline = self._started_at + START_TIMEOUT
        while time.perf_counter() < deadline:
            if self.process.poll() is not None:
                raise AssertionError(f"the server ended with status {self.process.returncode}:\n{self.output()}")
            try:
                status, _ = get(f"{self.url}/healthz")
            except (OSError, http.client.HTTPException):
                time.sleep(0.01)
                continue
            assert status == 200, f"/healthz answered {status}"
            self.listened_after = time.perf_counter() - self._started_at
            return
        raise AssertionError(f"the server did not listen within {START_TIMEOUT:g} s:\n{self.output()}")

    def interrupt(self) -> int:
        """Press Ctrl-C and return the exit status."""
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(STOP_TIMEOUT)

    def stop(self) -> None:
        """Ctrl-C, and insist on a clean exit: known status, no stack trace."""
        status = self.process.poll()
        assert status is None, f"the server had ended by itself with status {status}:\n{self.output()}"
        status = self.interrupt()
        assert status in CLEAN_EXITS, f"exit status {status} after Ctrl-C:\n{self.output()}"
        assert "Traceback" not in self.output(), self.output()

    def discard(self) -> None:
        """End the process whatever its state, and drop its output."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self._output.close()


@contextmanager
def running_deltalab(
    *arguments: str, command: Sequence[str] = DELTALAB, cwd: Path | None = None
) -> Iterator[RunningServer]:
    """A listening server for a `with` block; leaving the block stops it, unless that was done inside."""
    server = RunningServer(*arguments, command=command, cwd=cwd)
    try:
        server.wait_until_listening()
        yield server
        if server.process.returncode is None:
            server.stop()
    finally:
        server.discard()


ServerFactory = Callable[..., RunningServer]
"""`make("--robot", "linear")` starts one more server."""

"""The event loop as a buffer of messages sees it."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable


class NearLoop:
    """The event loop as a message buffer sees it: on the loop's own thread, waking it is a plain call.

    viser wakes it through a pipe for every message, which costs two system calls.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop
        self._thread = threading.get_ident()

    def call_soon_threadsafe(self, wake: Callable[[], None]) -> None:
        if threading.get_ident() == self._thread:
            wake()
        else:
            self._loop.call_soon_threadsafe(wake)

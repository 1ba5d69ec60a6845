"""An Uno in real time behind a pseudo terminal, for pyserial and for the whole app.

By hand: `python -m tests.support.emulators.uno.live delta3_dc` prints the port to connect to.
"""

from __future__ import annotations

import contextlib
import errno
import os
import select
import sys
import threading
import time
import tty

from tests.support.emulators.uno.rig import Rig

SLIP_S = 0.1
"""Farther behind than this the board does not catch up, as a board in a debugger would not."""


class UnoPty:
    """A robot in a thread of its own. Opening the port resets it, as DTR does with a real Uno."""

    def __init__(self, variant: str, boot_ms: int = 1000) -> None:
        self.rig = Rig(variant)
        self.rig.uno.clear_reset_cause()
        self._boot_ms = boot_ms
        self._master, slave = os.openpty()
        tty.setraw(slave)
        os.set_blocking(self._master, False)
        self.port = os.ttyname(slave)
        os.close(slave)  # so that the master can tell when somebody opens it
        self.is_open = False
        """Whether the board sees somebody at the other end."""
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._live, name="uno", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Unplug it; twice does no harm."""
        if self._ended.is_set():
            return
        self._ended.set()
        self._thread.join()
        os.close(self._master)
        self.rig.close()

    def _live(self) -> None:
        begin = time.monotonic() - 1e-6 * self.rig.uno.now_us
        while not self._ended.is_set():
            self._pass_on_bytes()
            self._advance()
            ahead = 1e-6 * self.rig.uno.now_us - (time.monotonic() - begin)
            if ahead > 0.0:
                self._ended.wait(ahead)
            elif ahead < -SLIP_S:
                begin -= ahead

    def _advance(self) -> None:
        """One step of the plant, a millisecond; what the board said goes to the port."""
        self.rig.uno.run(self.rig.plant.step_us)
        self.rig.plant.step(self.rig.uno)
        said = self.rig.uno.take()
        if said and self.is_open:
            with contextlib.suppress(BlockingIOError):  # nobody reads: a real line would lose the bytes too
                os.write(self._master, said)

    def _pass_on_bytes(self) -> None:
        poll = select.poll()
        poll.register(self._master, select.POLLIN)
        events = dict(poll.poll(0)).get(self._master, 0)
        is_open = not events & select.POLLHUP
        if is_open and not self.is_open:
            self.rig.uno.reset(self._boot_ms)
        self.is_open = is_open
        if is_open and events & select.POLLIN:
            try:
                self.rig.uno.send(os.read(self._master, 4096))
            except OSError as closed:
                if closed.errno != errno.EIO:  # closed just now
                    raise


def main() -> None:
    """Run until interrupted."""
    board = UnoPty(sys.argv[1] if len(sys.argv) > 1 else "delta3_servo")
    print(board.port, flush=True)
    try:
        threading.Event().wait()
    except KeyboardInterrupt:
        board.close()


if __name__ == "__main__":
    main()

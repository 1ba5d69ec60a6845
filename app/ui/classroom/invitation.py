"""How students find the class: its address, the QR code of it, and what the terminal says."""

from __future__ import annotations

import io
import socket
from typing import NamedTuple

from app.ui.guard import is_loopback

EVERYWHERE = ("0.0.0.0", "::", "")
_ELSEWHERE = ("192.0.2.1", 9)
"""An address that nobody has: nothing is sent there, but the system says by which of its own it would go."""

ONLY_HERE = "Students cannot reach this computer: start with --host 0.0.0.0 to let them in."


class Invitation(NamedTuple):
    """To a class on this computer."""

    host: str
    """On which the server listens."""
    port: int
    code: str

    @property
    def only_here(self) -> bool:
        return is_loopback(self.host)

    @property
    def everywhere(self) -> bool:
        return self.host in EVERYWHERE

    @property
    def address(self) -> str:
        """Of the server, for the students' browsers."""
        host = "localhost" if self.only_here else lan_address() if self.everywhere else self.host
        return f"http://{f'[{host}]' if ':' in host else host}:{self.port}"

    @property
    def link(self) -> str:
        return f"{self.address}/?class={self.code}"

    def text(self, pin: str, encoding: str) -> str:
        """For a terminal that shows this encoding."""
        lines = [f"Students join at {self.link}", f"Class code {self.code}, instructor's PIN {pin}"]
        return "\n".join([*lines, ONLY_HERE] if self.only_here else [*lines, *self._drawn(encoding)])

    def svg(self) -> str:
        """The QR code, dark on white, for a page."""
        import segno

        return segno.make(self.link, error="m", micro=False).svg_inline(scale=5, border=3, light="#fff", omitsize=True)

    def _drawn(self, encoding: str) -> list[str]:
        """The QR code in blocks; nothing where the terminal has none."""
        import segno

        drawn = io.StringIO()
        segno.make(self.link, error="l", micro=False).terminal(drawn, border=2, compact=True)
        try:
            drawn.getvalue().encode(encoding)
        except (UnicodeEncodeError, LookupError):
            return []
        return drawn.getvalue().splitlines()


def lan_address() -> str:
    """This computer's address in its network; its name where there is none."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(_ELSEWHERE)
        except OSError:
            return socket.gethostname()
        return probe.getsockname()[0]

"""Whose pages are open."""

from __future__ import annotations

from collections import Counter


class Presence:
    """Open pages by browser."""

    def __init__(self) -> None:
        self._pages: Counter[str] = Counter()

    def came(self, browser: str) -> None:
        self._pages[browser] += 1

    def went(self, browser: str) -> None:
        self._pages[browser] -= 1
        if self._pages[browser] <= 0:
            del self._pages[browser]

    def browsers(self) -> list[str]:
        """Browsers with a page that is open."""
        return list(self._pages)

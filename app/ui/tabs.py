"""The tabs of a page: which one is in front, and how another one comes there."""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable

import viser

from app.signal import Signal
from app.ui.tab_bell import on_tab_opened
from app.ui.viser_adapter import run_javascript

LABELS = ("Robot", "Control", "Motion", "Draw", "Hardware", "View")
FIRST = LABELS[0]

# A docked tab comes to the front by a key, one of a phone's sheet by a click, which our bells hear as well.
_SHOW = """
for (const tab of document.querySelectorAll('[role="tab"]'))
  if (tab.textContent.trim() === LABEL) {
    tab.dispatchEvent(new KeyboardEvent("keydown", {key: "Enter", bubbles: true}));
    tab.click();
    break;
  }
"""


async def _nothing() -> None:
    """Behind a tab that needs nothing when it is opened."""


class Tabs:
    """Of the panel on the right."""

    def __init__(self, client: viser.ClientHandle) -> None:
        self._client = client
        self.front = FIRST
        """Label of the tab that was opened last."""
        self.changed: Signal[str] = Signal()

    def listen(self, label: str, opened: Callable[[], Awaitable[None]] = _nothing) -> None:
        """Notice when this tab is opened, and call `opened` then; the tab must be on the page already."""

        async def come() -> None:
            self._note(label)
            await opened()

        on_tab_opened(self._client, label, come)

    def show(self, label: str) -> None:
        """Bring a tab to the front, as a click on it would."""
        if label not in LABELS:
            raise ValueError(f"no tab {label!r}")
        if label != self.front:
            self._note(label)
            run_javascript(self._client, _SHOW.replace("LABEL", json.dumps(label)))

    def _note(self, label: str) -> None:
        if label != self.front:
            self.front = label
            self.changed.emit(label)

"""A page that is wanted alive says so once a second; nothing is sent by the others."""

from __future__ import annotations

from collections.abc import Callable

import viser

from app.ui.viser_adapter import element_id, run_javascript

_SCRIPT = """
let timer = null, beat = false;
window.deltalabAlive = (wanted) => {
  clearInterval(timer);
  if (!wanted) return;
  const say = () => {
    beat = !beat;
    window.__viserMutable.sendMessage({type: "GuiUpdateMessage", uuid: "UUID", updates: {value: beat}});
  };
  timer = setInterval(say, 1000);
  say();
};
"""


class SignOfLife:
    """The page's heartbeat. A page that hangs or has gone is silent."""

    def __init__(self, client: viser.ClientHandle, heard: Callable[[], None]) -> None:
        self._client = client
        self._wanted = False
        wire = client.gui.add_checkbox("Sign of life", False, visible=False)
        run_javascript(client, _SCRIPT.replace("UUID", element_id(wire)))

        @wire.on_update
        async def _(_: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            heard()

    def want(self, wanted: bool) -> None:
        """Begin or end it."""
        if wanted != self._wanted:
            self._wanted = wanted
            run_javascript(self._client, f"window.deltalabAlive({'true' if wanted else 'false'})")

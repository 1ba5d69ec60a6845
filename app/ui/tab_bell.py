"""To know when somebody opens a tab, which viser itself does not tell."""

from __future__ import annotations

from collections.abc import Awaitable, Callable

import viser

from app.ui.viser_adapter import element_id, run_javascript

_SCRIPT = """
let rung = false;
document.addEventListener("click", (event) => {
  const tab = event.target.closest?.('[role="tab"]');
  if (!tab || tab.textContent.trim() !== "LABEL") return;
  rung = !rung;
  window.__viserMutable.sendMessage({type: "GuiUpdateMessage", uuid: "UUID", updates: {value: rung}});
}, true);
"""


def on_tab_opened(client: viser.ClientHandle, label: str, opened: Callable[[], Awaitable[None]]) -> None:
    """Call `opened` whenever somebody clicks the tab with this label: a script on the page flips a hidden checkbox."""
    bell = client.gui.add_checkbox(f"{label} opened", False, visible=False)
    run_javascript(client, _SCRIPT.replace("LABEL", label).replace("UUID", element_id(bell)))

    @bell.on_update
    async def _(_: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
        await opened()

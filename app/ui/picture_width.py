"""How wide the picture of the robot is on a browser's page, which viser tells in the display's pixels only."""

from __future__ import annotations

import viser

from app.signal import Signal
from app.ui.viser_adapter import element_id, run_javascript

_WIDEST_PX = 20000
_SCRIPT = """
const canvas = document.querySelector("canvas[data-engine]");
const tell = () => window.__viserMutable.sendMessage(
  {type: "GuiUpdateMessage", uuid: "UUID", updates: {value: canvas.clientWidth}});
let later = 0;
if (canvas) {
  tell();
  new ResizeObserver(() => { clearTimeout(later); later = setTimeout(tell, 300); }).observe(canvas);
}
"""


class PictureWidth:
    """In the page's pixels, which are what panels are measured in: a phone's display has two or three for each."""

    def __init__(self, client: viser.ClientHandle) -> None:
        self._client = client
        self.known: Signal[int] = Signal()
        """The page has told it for the first time."""
        self._told = client.gui.add_number("Width of the picture", 0, min=0, max=_WIDEST_PX, visible=False)
        self._is_known = False

        @self._told.on_update
        async def _(event: viser.GuiEvent[viser.GuiNumberHandle[int]]) -> None:
            if not self._is_known:
                self._is_known = True
                self.known.emit(round(event.target.value))

        run_javascript(client, _SCRIPT.replace("UUID", element_id(self._told)))

    @property
    def px(self) -> int:
        """As the page told it last; until it has, as viser has it."""
        return round(self._told.value) or self._client.camera.image_width

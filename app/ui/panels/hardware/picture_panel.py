"""The robot on the table and the one in the picture: what is shown of it, and whether it follows the gizmo."""

from __future__ import annotations

import viser

from app.ui import theme
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.mirror import Mirror
from app.ui.panels.text import small
from app.ui.viser_adapter import show_value

LEGEND = (
    f'<span style="color:{theme.css(theme.ACTUAL)}">■</span> The light blue ghost is the robot as its sensors see it, '
    "once it is homed. The robot in full colours is the one that you drag."
)


class PicturePanel:
    """The folder `Picture and gizmo`."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk, mirror: Mirror) -> None:
        self._session = session = desk.session
        gui = client.gui
        with gui.add_folder("Picture and gizmo"):
            self._mirror = gui.add_checkbox(
                "Mirror the gizmo",
                mirror.on,
                hint="Drag the gizmo: the robot on the table follows, at most at 250 mm/s",
            )
            self._measured = gui.add_checkbox("Show the measured robot", session.view.measured)
            self._follow = gui.add_checkbox(
                "Follow the robot", session.view.follow, hint="While it moves, the picture shows its set-point"
            )
            gui.add_html(small(LEGEND))
        mirror.switched.connect(lambda on: show_value(self._mirror, on))
        session.view_changed.connect(lambda _: self._show())

        @self._mirror.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            mirror.switch(event.target.value)

        @self._measured.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            session.show(measured=event.target.value)

        @self._follow.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            session.show(follow=event.target.value)

    def _show(self) -> None:
        show_value(self._measured, self._session.view.measured)
        show_value(self._follow, self._session.view.follow)

"""Move the robot by hand: a joint or an axis of the tool, in steps or for as long as a button is held."""

from __future__ import annotations

import viser

from app.link.status import LinkStatus
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.hold_to_run import HoldToRun
from app.ui.hardware.jogging import STEPS, JogAxis, axes_of, jog_of, key_of
from app.ui.hardware.verbs import not_ready
from app.ui.panels.button_grid import CLASS, ButtonGrid, Cell
from app.ui.panels.hardware.where_table import where_table
from app.ui.panels.text import small
from app.ui.panels.units import SHOWN_UNIT, si

HOLD = "Hold to run"
STEP_TITLES = {f"{size:g} mm or °": size for size in STEPS}
SPACES = {"Joints": "joint", "Tool": "pose"}
JOG_ACTIVITIES = ("idle", "jog", "step", "mirror")


class JogPanel:
    """The folder `Jog`."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk) -> None:
        self._desk = desk
        gui = client.gui
        with gui.add_folder("Jog"):
            self._where = gui.add_html("")
            self._space = gui.add_dropdown("Move", tuple(SPACES), initial_value="Joints")
            self._step = gui.add_dropdown("By", (HOLD, *STEP_TITLES), initial_value=HOLD)
            self._speed = gui.add_slider("Jog speed (%)", 5, 100, 5, 30)
            self._hold = HoldToRun(client, self._held, lambda _: desk.jog_release())
            self._pad = gui.add_html("")
            self._grid = ButtonGrid(client, "Jog", self._press, desk.tell, columns=2)
        desk.beat.connect(self._show_where)
        desk.status_changed.connect(lambda _: self._arrange())
        desk.me_changed.connect(lambda _: self._arrange())
        self._arrange()

        @self._space.on_update
        async def _(_: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._arrange()

        @self._step.on_update
        async def _(_: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._arrange()

    def _held(self, key: str) -> None:
        """Called every 50 ms while a button is held."""
        found = jog_of(key, self._desk.status, self._speed.value / 100.0)
        if found is not None and not self._why_not(found[1]):
            self._desk.jog(found[0])

    def _press(self, key: str) -> None:
        found = jog_of(key, self._desk.status, self._speed.value / 100.0)
        size = STEP_TITLES.get(self._step.value)
        if found is not None and size is not None:
            jog, axis = found
            self._desk.step(jog, si(size, axis.unit))

    def _arrange(self) -> None:
        """Armed buttons where something is to be held, else plain ones."""
        robot = self._desk.status.robot
        axes = [] if robot is None else axes_of(robot, "joint" if self._space.value == "Joints" else "pose")
        armed = self._step.value == HOLD and bool(axes) and not self._why_not(axes[0])
        pad = self._armed(axes) if armed else "" if axes else small("Connect a board: its joints come here.")
        if pad != self._pad.content:
            self._pad.content = pad
        self._grid.visible = not armed and bool(axes)
        self._grid.show([self._cell(axis, direction) for axis in axes for direction in (-1, 1)])

    def _armed(self, axes: list[JogAxis]) -> str:
        buttons = "".join(
            self._hold.button_html(key_of(axis, d), _label(axis, d), f"Moves {axis.name} while it is held")
            for axis in axes
            for d in (-1, 1)
        )
        return f'<div class="{CLASS}" style="grid-template-columns:1fr 1fr;touch-action:none">{buttons}</div>'

    def _cell(self, axis: JogAxis, direction: int) -> Cell:
        size = STEP_TITLES.get(self._step.value, STEPS[0])
        hint = f"Moves {axis.name} by {direction * size:+g} {SHOWN_UNIT[axis.unit]}"
        return Cell(key_of(axis, direction), _label(axis, direction), hint, self._why_not(axis))

    def _why_not(self, axis: JogAxis) -> str:
        """Joints may be jogged before homing, the tool may not."""
        status = self._desk.status
        if reason := not_ready(status, self._desk.me, homed=axis.space == "pose"):
            return reason
        return "" if status.activity in JOG_ACTIVITIES else "The robot is busy: wait, or cancel what it does."

    def _show_where(self, status: LinkStatus) -> None:
        table = where_table(status)
        if table != self._where.content:
            self._where.content = table


def _label(axis: JogAxis, direction: int) -> str:
    return f"{axis.name} {'+' if direction > 0 else '−'}"

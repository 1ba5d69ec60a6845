"""What the board is set to: gains, limits, speeds, safety. Everything that is written is read back and compared."""

from __future__ import annotations

import viser

from app.link.protocol.settings import SETTINGS, is_live
from app.link.status import LinkStatus
from app.ui.hardware.board_settings import ALL, GROUPS, Edits, shown_as
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.verbs import NO_BOARD, not_in_control, not_off
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.options import show_options
from app.ui.panels.text import small
from app.ui.viser_adapter import show_value

UNKNOWN = 0.0
"""Shown until the board was asked."""


class SettingsPanel:
    """The folder `Settings of the board`."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk) -> None:
        self._desk = desk
        self._edits = Edits()
        self._built_for: tuple[str, str] | None = None
        self._fields: dict[str, viser.GuiNumberHandle[float]] = {}
        self._gui = gui = client.gui
        with gui.add_folder("Settings of the board", expand_by_default=False):
            self._group = gui.add_dropdown("Show", tuple(GROUPS))
            self._joint = gui.add_dropdown("Joint", (ALL,))
            self._place = gui.add_folder(None)
            self._said = gui.add_html("")
            self._grid = ButtonGrid(client, "Settings", self._press, desk.tell, columns=4)
        desk.status_changed.connect(self._follow)
        desk.me_changed.connect(lambda _: self._follow(desk.status))
        self._follow(desk.status)

        @self._group.on_update
        async def _(_: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._follow(desk.status)

        @self._joint.on_update
        async def _(_: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._refresh(desk.status)

    def _follow(self, status: LinkStatus) -> None:
        names = () if status.robot is None else status.robot.joint_names
        options = (ALL, *names)
        if self._joint.options != options:
            self._edits.clear()
            show_options(self._joint, options, ALL)
        self._build(status)
        self._refresh(status)
        self._grid.show(self._cells(status))

    def _build(self, status: LinkStatus) -> None:
        """Other fields for another group or another robot."""
        wanted = (self._group.value, "" if status.robot is None else status.robot.name)
        if wanted == self._built_for:
            return
        self._built_for = wanted
        for field in self._fields.values():
            field.remove()
        self._fields = {}
        self._joint.visible = SETTINGS[GROUPS[self._group.value][0]].per_joint
        if status.robot is not None:
            with self._place:
                self._fields = {name: self._add(name, status) for name in GROUPS[self._group.value]}

    def _add(self, name: str, status: LinkStatus) -> viser.GuiNumberHandle[float]:
        assert status.robot is not None
        shown = shown_as(name, status.robot)
        title = name.replace("_", " ")
        label = f"{title} ({shown.unit})" if shown.unit else title
        field = self._gui.add_number(label, UNKNOWN, step=1e-6, hint=shown.setting.label)

        @field.on_update
        async def _(event: viser.GuiEvent[viser.GuiNumberHandle[float]]) -> None:
            robot = self._desk.status.robot
            if robot is not None:
                self._edits.type(name, self._joint.value, event.target.value, robot)
                self._grid.show(self._cells(self._desk.status))

        return field

    def _refresh(self, status: LinkStatus) -> None:
        if status.robot is None:
            self._say("Connect a board to see its settings.")
            return
        values = {name: self._edits.value(name, self._joint.value, status, status.robot) for name in self._fields}
        for name, field in self._fields.items():
            value = values[name]
            show_value(field, UNKNOWN if value is None else value)
            if field.disabled != (value is None):
                field.disabled = value is None
        self._say("Press Read to ask the board." if None in values.values() else "")

    def _say(self, sentence: str) -> None:
        content = small(sentence) if sentence else ""
        if content != self._said.content:
            self._said.content = content

    def _cells(self, status: LinkStatus) -> list[Cell]:
        me, no_board = self._desk.me, "" if status.robot is not None else NO_BOARD
        unchanged = "" if len(self._edits) else "Nothing was changed."
        live = all(is_live(id) for id in self._edits.values)
        blocked = not_in_control(status, me) if live else not_off(status, me)
        return [
            Cell("read", "Read", "Ask the board for all of them; forgets what was typed", no_board),
            Cell("apply", "Apply", "Write what was changed, read it back and compare", unchanged or blocked, "main"),
            Cell("save", "Save", "Keep them on the board, also without power", not_off(status, me)),
            Cell("defaults", "Defaults", "As the firmware was built; Save keeps them", not_off(status, me)),
        ]

    def _press(self, key: str) -> None:
        desk = self._desk
        if key == "read":
            self._edits.clear()
            desk.ask(desk.link.read_settings(), lambda _: self._follow(desk.status))
        elif key == "apply":
            desk.apply_settings(self._edits.values, self._applied)
        elif key == "save":
            desk.apply_settings({}, lambda: desk.tell_good("The board has kept its settings."), save=True)
        else:
            self._edits.clear()
            desk.restore_defaults()

    def _applied(self) -> None:
        self._edits.clear()
        self._follow(self._desk.status)
        self._desk.tell_good("The board has taken the settings; read back, they agree.")

"""What can go wrong, tried on an emulated board: its cable, its sensors, its joints, its emergency stop."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import viser

from app.link.emulated.faults import Faults
from app.link.status import LinkStatus
from app.ui.hardware.desk import HardwareDesk
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.options import show_options
from app.ui.panels.text import small
from app.ui.viser_adapter import show_value

NONE: str = "None"
ABOUT = "This board is emulated: break it, and see what the lab and the firmware do about it."
AMOUNTS = {
    "noise": ("Garbled bytes (%)", 20.0, 0.5, 0.01),
    "loss": ("Lost bytes (%)", 20.0, 0.5, 0.01),
    "delay_s": ("Delay each way (ms)", 300.0, 10.0, 1e-3),
}
"""Field of `Faults` -> label, highest value and step as shown, and what the shown value is multiplied with."""

JOINTS = {"stuck_joint": "Stuck joint", "limit_switch": "Limit switch closed", "sensor_broken": "Sensor broken"}
SWITCHES = {"estop": "Emergency stop pressed", "unplugged": "Cable pulled"}


class FaultsPanel:
    """The folder `Try a fault`; there for emulated boards only."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk) -> None:
        self._desk = desk
        self._names: tuple[str, ...] = ()
        gui = client.gui
        self._folder = gui.add_folder("Try a fault", expand_by_default=False, visible=False)
        with self._folder:
            gui.add_html(small(ABOUT))
            self._switches = {name: gui.add_checkbox(label, False) for name, label in SWITCHES.items()}
            self._joints = {name: gui.add_dropdown(label, (NONE,)) for name, label in JOINTS.items()}
            self._amounts = {
                name: gui.add_slider(label, 0.0, high, step, 0.0) for name, (label, high, step, _) in AMOUNTS.items()
            }
            self._heal = ButtonGrid(client, "Faults", lambda _: self._set(Faults()), desk.tell, columns=1)
            self._heal.show([Cell("heal", "Mend everything", "As good as new")])
        self._listen()
        desk.status_changed.connect(self._follow)
        self._follow(desk.status)

    def _listen(self) -> None:
        def listen(handle: Any, name: str, read: Callable[[Any], object]) -> None:
            @handle.on_update
            async def _(event: viser.GuiEvent[Any]) -> None:
                self._change(**{name: read(event.target.value)})

        for name, switch in self._switches.items():
            listen(switch, name, bool)
        for name, joint in self._joints.items():
            listen(joint, name, lambda title: self._names.index(title) if title in self._names else None)
        for name, slider in self._amounts.items():
            listen(slider, name, lambda value, per_shown=AMOUNTS[name][3]: value * per_shown)

    def _change(self, **values: Any) -> None:
        faults = self._desk.workshop.faults
        if faults is not None:
            self._set(replace(faults, **values))

    def _set(self, faults: Faults) -> None:
        if refusal := self._desk.break_board(faults):
            self._desk.tell(refusal)
        self._follow(self._desk.status)

    def _follow(self, status: LinkStatus) -> None:
        faults = self._desk.workshop.faults
        if self._folder.visible != (faults is not None):
            self._folder.visible = faults is not None
        if faults is None:
            return
        if status.robot is not None and status.robot.joint_names != self._names:
            self._names = status.robot.joint_names
        for name, switch in self._switches.items():
            show_value(switch, getattr(faults, name))
        for name, joint in self._joints.items():
            broken = getattr(faults, name)
            show_options(joint, (NONE, *self._names), NONE if broken is None else self._names[broken])
        for name, slider in self._amounts.items():
            _, high, step, per_shown = AMOUNTS[name]
            show_value(slider, min(high, round(getattr(faults, name) / per_shown / step) * step))

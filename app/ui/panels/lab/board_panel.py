"""The gains of the robot on the table: send those of the lab, or take over those of the board."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import viser

from app.errors import UserMistake
from app.ui.compute import Worker
from app.ui.lab.desk import ControlDesk
from app.ui.panels.button_grid import STYLE, ButtonGrid, Cell
from app.ui.panels.text import small
from app.ui.refusal import Refusal

if TYPE_CHECKING:
    from app.link.status import LinkStatus
    from app.link.twin.gains import GainCheck
    from app.ui.hardware.desk import HardwareDesk

NO_FILTER_RAD_S = 1e4
"""A board's derivative without filter, as the lab's field takes it."""

SEND_HINT = "They are checked, sent to every joint, read back and compared"
READ_HINT = "The lab takes over the gains that the board has"


class BoardPanel:
    """The folder `Robot on the table`; seen only where that is the same kind of robot, with DC drives."""

    def __init__(self, client: viser.ClientHandle, desk: ControlDesk, worker: Worker) -> None:
        self._client = client
        self._desk = desk
        self._worker = worker
        self._checking = False
        self._folder = client.gui.add_folder("Robot on the table", visible=False)

    def furnish(self, hardware: HardwareDesk) -> None:
        """There is a robot: from now on the folder comes and goes with it."""
        self._hardware = hardware
        with self._folder:
            self._client.gui.add_html(STYLE)
            self._grid = ButtonGrid(self._client, "Board's gains", self._press, hardware.tell, columns=2)
            self._said = self._client.gui.add_html("")
        hardware.status_changed.connect(self._follow)
        hardware.me_changed.connect(lambda _: self._follow(hardware.status))
        hardware.session.robot_changed.connect(lambda _: self._follow(hardware.status))
        self._follow(hardware.status)

    def failed(self) -> None:
        """The worker could not do it, and has said so."""
        self._checking = False
        self._follow(self._hardware.status)

    def _press(self, key: str) -> None:
        if key == "read":
            self._read()
        elif not self._checking:
            self._send()

    def _send(self) -> None:
        from app.ui.lab.board_jobs import gains_to_send

        status, settings = self._hardware.status, self._desk.settings
        if status.robot is None or status.identity is None:
            return
        self._checking = True
        self._follow(status)
        robot, period_s = status.robot, 1e-6 * status.identity.period_us
        joints = len(robot.joint_names)
        self._worker.request(
            self._receive, gains_to_send, settings.pid, settings.motor, period_s, robot.joint_unit, joints
        )

    def _receive(self, result: tuple[dict[int, float], GainCheck] | Refusal) -> None:
        self._checking = False
        self._follow(self._hardware.status)
        if isinstance(result, Refusal):
            self._hardware.tell(result.reason)
            return
        values, check = result
        said = f"All joints of the board have these gains, read back. {check.sentence}"
        self._hardware.apply_settings(values, lambda: self._say(said))

    def _read(self) -> None:
        from app.link.twin.gains import gains_from_board

        status = self._hardware.status
        if status.robot is None:
            return
        unit, joints = status.robot.joint_unit, range(len(status.robot.joint_names))
        try:
            found = [gains_from_board(status.settings, joint, unit) for joint in joints]
        except UserMistake as refusal:
            self._hardware.tell(str(refusal))
            return
        pid = replace(found[0], n=min(found[0].n, NO_FILTER_RAD_S))
        self._desk.change(kp=pid.kp, ki=pid.ki, kd=pid.kd, n=pid.n)
        alike = all(other == found[0] for other in found)
        self._say("These are the board's gains." if alike else "The joints have different gains: these are of joint 1.")

    def _say(self, sentence: str) -> None:
        self._said.content = small(sentence)
        self._client.flush()

    def _follow(self, status: LinkStatus) -> None:
        visible = self._fits(status)
        if self._folder.visible != visible:
            self._folder.visible = visible
        if visible:
            send = Cell("send", "Send gains to the board", SEND_HINT, self._why_not_send(status), "main")
            self._grid.show([send, Cell("read", "Read gains from the board", READ_HINT)])

    def _fits(self, status: LinkStatus) -> bool:
        """Other drives have no PID on the board."""
        from app.link.protocol.codes import DriveKind

        if status.phase != "ready" or status.robot is None or status.identity is None:
            return False
        return status.robot.name == self._desk.settings.robot and status.identity.drive is DriveKind.DC

    def _why_not_send(self, status: LinkStatus) -> str:
        from app.ui.hardware.verbs import not_still

        if self._checking:
            return "The gains are being checked: wait a moment."
        return not_still(status, self._hardware.me)

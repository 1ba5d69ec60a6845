"""What worker processes do before gains go to a board. Nothing here may import viser."""

from __future__ import annotations

from app.control import Motor, Pid
from app.link.errors import LinkError
from app.link.twin.gains import GainCheck, check_gains, gains_for_board
from app.ui.refusal import Refusal


def gains_to_send(
    pid: Pid, motor: Motor, period_s: float, joint_unit: str, joints: int
) -> tuple[dict[int, float], GainCheck] | Refusal:
    """The settings of all joints, if the motor would be calm with them at the board's period."""
    try:
        return gains_for_board(pid, joint_unit, range(joints)), check_gains(pid, motor, period_s)
    except LinkError as refusal:
        return Refusal(str(refusal))

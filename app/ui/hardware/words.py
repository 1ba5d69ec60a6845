"""The state of the robot on the table in a word, a sentence and a colour."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from app.link.protocol.codes import Flag, State, describe_fault
from app.ui import theme

if TYPE_CHECKING:
    from app.link.protocol.messages import Telemetry
    from app.link.status import LinkStatus

GOOD, BUSY, CARE = theme.LEGS[2], theme.LEGS[0], theme.LEGS[1]


class Condition(NamedTuple):
    """What everybody should see at a glance."""

    word: str
    sentence: str
    color: theme.Rgb
    mark: str
    """A shape, for whoever sees no colours."""


_PHASES = {
    "none": ("Not connected", theme.REFERENCE, "○"),
    "connecting": ("Connecting", CARE, "◌"),
    "lost": ("Connection lost", theme.WARNING, "▲"),
    "refused": ("Refused", theme.WARNING, "▲"),
}
_STATES = {
    State.OFF: Condition("Motors off", "Switch the motors on with Enable.", theme.REFERENCE, "○"),
    State.READY: Condition("Idle", "The motors hold; the robot is ready to move.", GOOD, "●"),
    State.MOVING: Condition("Moving", "", BUSY, "▶"),
    State.HOMING: Condition("Homing", "The robot looks for its home position: keep clear.", BUSY, "▶"),
    State.TESTING: Condition("Testing", "A short test moves one joint: keep clear.", BUSY, "▶"),
    State.HELD: Condition(
        "Held", "Set-points stopped coming, so the motors hold. Continue goes on.", theme.LEGS[1], "‖"
    ),
    State.STOPPED: Condition(
        "Stopped", "Somebody pressed Stop; the motors hold. Clear allows motion again.", CARE, "■"
    ),
}
_DOING = {
    "jog": "Jogging for as long as the button is held.",
    "step": "One step.",
    "mirror": "It follows the gizmo.",
    "run": "It runs “{title}”.",
    "paused": "“{title}” is paused: Continue goes on with it.",
    "test": "A short test moves one joint: keep clear.",
}


def condition(status: LinkStatus) -> Condition:
    """State of the connection first, then that of the board."""
    if status.phase != "ready" or status.telemetry is None:
        word, color, mark = _PHASES.get(status.phase, _PHASES["connecting"])
        return Condition(word, status.sentence, color, mark)
    return _of_board(status, status.telemetry)


def _of_board(status: LinkStatus, telemetry: Telemetry) -> Condition:
    if telemetry.state == State.FAULT:
        reason = describe_fault(telemetry.fault, telemetry.fault_joint)
        return Condition("Fault", reason, theme.WARNING, "▲")
    found = _STATES[telemetry.state]
    if telemetry.state == State.READY and not telemetry.flags & Flag.HOMED:
        return Condition("Not homed", "The robot does not know where its joints are: press Home.", CARE, "◆")
    doing = _DOING.get(status.activity, "").format(title=status.program_title)
    if doing and telemetry.state in (State.READY, State.MOVING):
        return found._replace(sentence=doing)
    return found

"""The one sentence that a person should know about the robot now."""

from __future__ import annotations

from app.link.protocol.codes import Flag, State, describe_fault
from app.link.protocol.messages import Telemetry
from app.link.status import Activity

_BY_STATE = {
    State.OFF: "The motors are off; switch them on to move the robot.",
    State.MOVING: "The robot moves.",
    State.HOMING: "The robot looks for its home position.",
    State.TESTING: "The board runs a test.",
    State.HELD: "The set-points stopped coming in time, so the robot holds; look that all is well, then resume.",
    State.STOPPED: "Stopped: the motors hold, nothing resumes by itself; clear the stop when all is well.",
}
LATCHED = (State.FAULT, State.STOPPED, State.HELD)
"""States that matter more than any news."""


def describe_state(telemetry: Telemetry, activity: Activity) -> str:
    """What the board does, and what to do next."""
    if telemetry.state is State.FAULT:
        return describe_fault(telemetry.fault, telemetry.fault_joint)
    if activity == "paused" and telemetry.state is State.READY:
        return "The program is paused; resume or cancel it."
    if telemetry.state is State.READY:
        homed = Flag.HOMED in telemetry.flags
        return "Ready." if homed else "Ready, but not homed: home the robot, or jog its joints."
    return _BY_STATE[telemetry.state]

"""What somebody may do with the robot now, and why not."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from app.link.protocol.codes import Flag, State

if TYPE_CHECKING:
    from app.link.lease import Person
    from app.link.status import LinkStatus

STANDING = (State.READY, State.MOVING)
STILL = (State.OFF, State.READY, State.HELD, State.STOPPED)
NO_BOARD = "Connect a board first."


class Verb(NamedTuple):
    """One button."""

    label: str
    hint: str
    why_not: Callable[[LinkStatus, Person], str]
    """Empty where it makes sense."""
    tone: str = ""


def holds(status: LinkStatus, me: Person) -> bool:
    return status.holder is not None and status.holder.key == me.key


def place_in_queue(status: LinkStatus, me: Person) -> int:
    """From 1; 0 for whoever does not wait."""
    return next((k for k, person in enumerate(status.queue, 1) if person.key == me.key), 0)


def not_in_control(status: LinkStatus, me: Person) -> str:
    """Why somebody may not move the robot at all."""
    if status.phase != "ready" or status.telemetry is None:
        return NO_BOARD
    if holds(status, me):
        return ""
    if status.holder is None:
        return "Request control first."
    return f"{status.holder.name} has control: request it and wait for your turn."


def not_allowed(status: LinkStatus, me: Person) -> str:
    """The same for what an instructor may do at any time."""
    return "" if me.instructor and status.telemetry is not None else not_in_control(status, me)


def not_ready(status: LinkStatus, me: Person, *, homed: bool = True) -> str:
    """Why somebody cannot begin a motion."""
    if reason := not_in_control(status, me):
        return reason
    assert status.telemetry is not None
    if status.telemetry.state not in STANDING:
        return _BLOCKED[status.telemetry.state]
    if homed and not status.telemetry.flags & Flag.HOMED:
        return "Home the robot first."
    return ""


def not_free(status: LinkStatus, me: Person, *, homed: bool = True) -> str:
    """Why somebody cannot begin something that nothing else may go on beside."""
    if reason := not_ready(status, me, homed=homed):
        return reason
    return "" if status.activity == "idle" else "The robot is busy: wait, or cancel what it does."


def not_off(status: LinkStatus, me: Person) -> str:
    """Why somebody cannot change what may be changed without power only."""
    if reason := not_in_control(status, me):
        return reason
    assert status.telemetry is not None
    return "" if status.telemetry.state == State.OFF else "Only with the motors off: press Power off first."


def not_still(status: LinkStatus, me: Person) -> str:
    """Why somebody cannot change what may be changed while the robot stands."""
    if reason := not_in_control(status, me):
        return reason
    assert status.telemetry is not None
    if status.telemetry.state not in STILL or status.activity not in ("idle", "paused"):
        return "The robot must stand still: wait, or cancel what it does."
    return ""


_BLOCKED = {
    State.OFF: "The motors are off: press Enable first.",
    State.HOMING: "The robot is being homed: wait until it is done.",
    State.TESTING: "A test runs: wait until it is done.",
    State.HELD: "The robot holds: press Continue first.",
    State.STOPPED: "The robot was stopped: press Clear first.",
    State.FAULT: "There is a fault: mend it, then press Clear.",
}


def _not_enable(status: LinkStatus, me: Person) -> str:
    if reason := not_in_control(status, me):
        return reason
    assert status.telemetry is not None
    if status.telemetry.state == State.OFF:
        return ""
    return _BLOCKED[State.FAULT] if status.telemetry.state == State.FAULT else "The motors are on already."


def _not_clear(status: LinkStatus, me: Person) -> str:
    if reason := not_allowed(status, me):
        return reason
    assert status.telemetry is not None
    if status.telemetry.state in (State.STOPPED, State.FAULT):
        return ""
    return "There is no stop and no fault to clear."


def _not_resume(status: LinkStatus, me: Person) -> str:
    if reason := not_allowed(status, me):
        return reason
    assert status.telemetry is not None
    if status.telemetry.state in (State.STOPPED, State.FAULT, State.OFF):
        return _BLOCKED[status.telemetry.state]
    if status.telemetry.state == State.HELD or status.activity == "paused":
        return ""
    return "Nothing waits to go on."


def _not_power_off(status: LinkStatus, me: Person) -> str:
    if reason := not_allowed(status, me):
        return reason
    assert status.telemetry is not None
    return "The motors are off." if status.telemetry.state == State.OFF else ""


def _not_pause(status: LinkStatus, me: Person) -> str:
    return not_allowed(status, me) or ("" if status.activity == "run" else "Nothing runs.")


def _not_cancel(status: LinkStatus, me: Person) -> str:
    return not_allowed(status, me) or ("" if status.activity in ("run", "paused") else "Nothing runs.")


def _not_request(status: LinkStatus, me: Person) -> str:
    if status.phase != "ready":
        return NO_BOARD
    if place := place_in_queue(status, me):
        return f"You wait already, in place {place}."
    return "You have control." if holds(status, me) else ""


def _not_release(status: LinkStatus, me: Person) -> str:
    return "" if holds(status, me) or place_in_queue(status, me) else "You do not have control."


def _not_take_over(status: LinkStatus, me: Person) -> str:
    if not me.instructor:
        return "Only an instructor takes over: give the PIN below."
    if status.phase != "ready":
        return NO_BOARD
    return "You have control." if holds(status, me) else ""


VERBS: dict[str, Verb] = {
    "enable": Verb("Enable", "Power on: the motors hold the joints where they are", _not_enable, "main"),
    "home": Verb("Home", "Find the home position: the robot moves", lambda s, me: not_free(s, me, homed=False)),
    "clear": Verb("Clear", "After Stop or a fault: allow motion again", _not_clear),
    "resume": Verb("Continue", "Go on after a hold or a pause", _not_resume),
    "power_off": Verb("Power off", "Without power the arms may fall: support them", _not_power_off, "risky"),
    "pause": Verb("Pause", "Stand still; Continue goes on", _not_pause),
    "cancel": Verb("Cancel", "Stand still and forget the rest", _not_cancel),
    "request": Verb("Request", "Take the robot, or a place in the queue", _not_request, "main"),
    "release": Verb("Hand over", "Give the robot to whoever is next", _not_release),
    "take_over": Verb("Take over", "The instructor has the robot at once", _not_take_over),
}
"""Name of a method of the link that needs nothing but a person -> its button."""

"""What the host may order in which state, and which set-points are accepted."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from app.link.emulated.twin import trial
from app.link.emulated.twin.guards import BEYOND, sensor_broken
from app.link.emulated.twin.machine import Machine
from app.link.protocol.codes import Command, DriveKind, Fault, Refusal, State, TargetKind, TestKind
from app.link.protocol.messages import Test
from app.link.protocol.settings import GEOMETRY_ID, SETTING_COUNT, is_live, setting_id

ON_LIMIT = 1e-4
"""rad or m: a target on its limit is still one after rounding."""
SHORTEST_S, LONGEST_S = 0.010, 0.040
"""In so much time the joints go to a target."""

_MANUAL, _PEN_DOWN = 1, 2
_REFUSALS = {
    State.READY: Refusal.OK,
    State.OFF: Refusal.NOT_ENABLED,
    State.HELD: Refusal.HELD,
    State.STOPPED: Refusal.STOPPED,
    State.FAULT: Refusal.FAULT,
}
_HOLDING = (State.READY, State.HELD, State.STOPPED)


def not_ready(m: Machine) -> Refusal:
    """Why something that needs READY is refused now."""
    return _REFUSALS.get(m.state, Refusal.BUSY)


def command(m: Machine, number: int) -> Refusal:
    """Carry out a command, if it may be."""
    return _COMMANDS[Command(number)](m) if number in tuple(Command) else Refusal.UNKNOWN


def _stop(m: Machine) -> Refusal:
    if m.powered and m.state != State.STOPPED:
        m.stop(State.STOPPED)
    return Refusal.OK


def _power_off(m: Machine) -> Refusal:
    if m.powered:
        m.power_off(State.OFF)
    return Refusal.OK


def _clear(m: Machine) -> Refusal:
    if m.state == State.STOPPED:
        m.rest()
    elif m.state == State.FAULT:
        return _clear_fault(m)
    elif m.state not in (State.OFF, State.READY):
        return not_ready(m)
    return Refusal.OK


def _clear_fault(m: Machine) -> Refusal:
    if m.estop_open:
        return Refusal.ESTOP
    if m.fault == Fault.SENSOR and any(sensor_broken(m, joint) for joint in range(m.joints)):
        return Refusal.FAULT
    m.state, m.fault, m.fault_joint = State.OFF, Fault.NONE, 0
    return Refusal.OK


def _enable(m: Machine) -> Refusal:
    if m.state != State.OFF:
        return not_ready(m)
    if not m.ticked:
        return Refusal.BUSY
    if m.drive_kind == DriveKind.DC and not all(m.room(j, q) >= -BEYOND for j, q in enumerate(m.position)):
        return Refusal.LIMIT
    m.power_on()
    return Refusal.OK


def _home(m: Machine) -> Refusal:
    refusal = Refusal.OK if m.state == State.HOMING else not_ready(m)
    if m.state == State.READY:
        m.begin_homing()
    return refusal


def _follow(m: Machine) -> Refusal:
    if m.state != State.HELD:
        return not_ready(m)
    m.rest()
    return Refusal.OK


def _halt(m: Machine) -> Refusal:
    if m.state not in (State.MOVING, State.HOMING, State.TESTING):
        return not_ready(m)
    m.stop(State.READY)
    return Refusal.OK


def _save(m: Machine) -> Refusal:
    if m.state != State.OFF:
        return Refusal.BUSY
    m.store.save_requested = True
    return Refusal.OK


def _defaults(m: Machine) -> Refusal:
    if m.state != State.OFF:
        return Refusal.BUSY
    serial = m.setting("serial")
    m.store.values = list(m.store.built_in)
    m.store.values[setting_id("serial")] = serial
    m.refresh()
    return Refusal.OK


_COMMANDS: dict[Command, Callable[[Machine], Refusal]] = {
    Command.STOP: _stop,
    Command.OFF: _power_off,
    Command.CLEAR: _clear,
    Command.ENABLE: _enable,
    Command.HOME: _home,
    Command.FOLLOW: _follow,
    Command.HALT: _halt,
    Command.SAVE: _save,
    Command.DEFAULTS: _defaults,
}


def change(m: Machine, id: int, value: float) -> Refusal:
    """Set a setting, if its value and the state allow it."""
    refusal = m.store.check(id, value)
    if refusal == Refusal.UNKNOWN:
        return refusal
    if m.state != State.OFF and not (m.state in _HOLDING and id < GEOMETRY_ID and is_live(id)):
        return Refusal.BUSY
    if refusal == Refusal.OK:
        m.store.values[id] = value
        m.refresh()
    return refusal


def read(m: Machine, id: int) -> tuple[Refusal, float]:
    """A setting's value."""
    return (Refusal.OK, m.store.values[id]) if id < SETTING_COUNT else (Refusal.UNKNOWN, 0.0)


def test(m: Machine, number: int, kind: int, joint: int, amplitude: float, duration_ms: int) -> Refusal:
    """Begin a test; the frame that began it may come again, as its answer may have been lost."""
    if m.state == State.TESTING and m.test is not None and m.test.number == number:
        return Refusal.OK
    refusal = trial.check(m, kind, joint, amplitude, duration_ms, not_ready(m))
    if refusal == Refusal.OK:
        m.begin_test(Test(TestKind(kind), joint, amplitude, duration_ms), number)
    return refusal


def setpoint(m: Machine, kind: int, flags: int, laser: int, *target: float) -> Refusal:
    """Follow a set-point, if it may be."""
    refusal = Refusal.OK if m.state == State.MOVING else not_ready(m)
    if refusal != Refusal.OK:
        return refusal
    if kind not in tuple(TargetKind) or flags & ~(_MANUAL | _PEN_DOWN) or not all(map(math.isfinite, target)):
        return Refusal.VALUE
    pose = target if kind == TargetKind.POSE else None
    if not m.homed and (pose is not None or not flags & _MANUAL):
        return Refusal.NOT_HOMED
    joints = target[: m.joints] if pose is None else m.inverse(pose)
    if not all(map(math.isfinite, joints)):
        return Refusal.REACH
    limited = [min(max(q, low), high) for q, (low, high) in zip(joints, m.limits, strict=True)]
    if any(abs(q - inside) > ON_LIMIT for q, inside in zip(joints, limited, strict=True)):
        return Refusal.LIMIT
    if _is_jump(m, limited):
        return Refusal.JUMP
    _follow_target(m, limited, flags, laser)
    return Refusal.OK


def _is_jump(m: Machine, joints: Sequence[float]) -> bool:
    ways = zip(joints, m.motion.setpoint, m.speeds, strict=True)
    return any(abs(there - here) > m.setting("jump") * speed for there, here, speed in ways)


def _follow_target(m: Machine, joints: list[float], flags: int, laser: int) -> None:
    m.manual, m.pen_down, m.laser = bool(flags & _MANUAL), bool(flags & _PEN_DOWN), laser
    if m.state == State.READY and (joints != m.motion.setpoint or m.motion.stop_left > 0.0):
        m.state = State.MOVING
        m.settled_us = 0
    m.tool.look_again()
    apart = 1e-6 * m.since(m.setpoint_us)
    m.motion.aim(joints, m.speeds, min(max(apart, SHORTEST_S), LONGEST_S))
    m.setpoint_us = m.now_us

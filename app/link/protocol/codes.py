"""The numbers of the protocol, version 1, and what they mean in words."""

from __future__ import annotations

from enum import IntEnum, IntFlag

PROTOCOL_VERSION = 1


class MessageType(IntEnum):
    """First byte of a payload: below 80 (hexadecimal) from the host, from there on from the board."""

    HELLO = 0x01
    ALIVE = 0x02
    SETPOINT = 0x03
    COMMAND = 0x04
    SET = 0x05
    GET = 0x06
    TEST = 0x07
    TELEMETRY = 0x81
    IDENTITY = 0x82
    ACK = 0x83
    SAMPLE = 0x84


class State(IntEnum):
    """What the board is doing."""

    OFF = 0
    READY = 1
    MOVING = 2
    HOMING = 3
    TESTING = 4
    HELD = 5
    STOPPED = 6
    FAULT = 7


class Fault(IntEnum):
    """Why the board switched its motors off."""

    NONE = 0
    ESTOP = 1
    LIMIT = 2
    SENSOR = 3
    FOLLOWING = 4
    HOMING = 5
    SWITCH = 6
    WATCHDOG = 7


class Refusal(IntEnum):
    """Why the board did not do what it was asked to."""

    OK = 0
    NOT_HOMED = 1
    NOT_ENABLED = 2
    STOPPED = 3
    FAULT = 4
    LIMIT = 5
    REACH = 6
    JUMP = 7
    VALUE = 8
    UNKNOWN = 9
    BUSY = 10
    ESTOP = 11
    HELD = 12


class Command(IntEnum):
    """What a board can be told."""

    STOP = 1
    OFF = 2
    CLEAR = 3
    ENABLE = 4
    HOME = 5
    FOLLOW = 6
    HALT = 7
    SAVE = 8
    DEFAULTS = 9


class BoardKind(IntEnum):
    """Where the core runs."""

    UNO = 1
    STM32F407 = 2
    HOST = 3


class RobotKind(IntEnum):
    """The robots, in the order of `app.robots.ROBOTS`."""

    PAR4 = 1
    DELTA3 = 2
    LINEAR = 3
    FIVEBAR = 4


class DriveKind(IntEnum):
    """What moves the joints."""

    SERVO = 1
    DC = 2
    STEPPER = 3


class Reset(IntEnum):
    """Why the board started."""

    POWER = 0
    LINE = 1
    WATCHDOG = 2


class SettingsSource(IntEnum):
    """Where the board's settings came from when it started."""

    BUILT_IN = 0
    STORED = 1
    DAMAGED = 2


class TargetKind(IntEnum):
    """What the four numbers of a set-point are."""

    JOINTS = 0
    POSE = 1


class TestKind(IntEnum):
    """What a test does to its joint."""

    PULSE = 0
    STEP = 1

    __test__ = False


class Flag(IntFlag):
    """Bits of telemetry."""

    HOMED = 1
    PEN_DOWN = 2
    LASER_ON = 4
    ESTOP_OPEN = 8
    POWERED = 16
    MANUAL = 32


_FAULTS = {
    Fault.NONE: "There is no fault.",
    Fault.ESTOP: "The emergency stop is pressed or its wire is broken; release it, then clear the fault.",
    Fault.LIMIT: "{joint} went beyond its limits; clear the fault and move it back inside by hand.",
    Fault.SENSOR: "The position sensor of {joint} gives no sensible value; check its wires, then clear the fault.",
    Fault.FOLLOWING: "{joint} does not follow, something holds it; free it, then clear the fault.",
    Fault.HOMING: "{joint} did not find its home position; check its switch and wires, then clear the fault.",
    Fault.SWITCH: "The limit switch of {joint} closed during motion; clear the fault and home the robot again.",
    Fault.WATCHDOG: "The board hung and was reset by its watchdog; clear the fault, and note what it was doing.",
}

_REFUSALS = {
    Refusal.OK: "Done.",
    Refusal.NOT_HOMED: "The robot does not know where its joints are; home it first.",
    Refusal.NOT_ENABLED: "The motors are off; switch them on first.",
    Refusal.STOPPED: "The robot was stopped; clear the stop first.",
    Refusal.FAULT: "The board reports a fault; remove its cause and clear it first.",
    Refusal.LIMIT: "That lies outside of the joint limits; choose a target inside.",
    Refusal.REACH: "The robot cannot reach that pose; choose a target closer to its home.",
    Refusal.JUMP: "The target is too far from where the robot is; go there in smaller steps.",
    Refusal.VALUE: "The board cannot take this number; choose one within the allowed range.",
    Refusal.UNKNOWN: "The board does not know this command, setting or joint; check that its firmware is up to date.",
    Refusal.BUSY: "The board cannot do this in its present state; wait until it is done, or switch the motors off.",
    Refusal.ESTOP: "The emergency stop is still pressed; release it first.",
    Refusal.HELD: "The robot holds because its set-points stopped coming; resume first.",
}


def describe_fault(fault: Fault, joint: int = 0) -> str:
    """One sentence on what is wrong and what to do. `joint` counts from 1, 0 is none in particular."""
    who = f"joint {joint}" if joint else "a joint"
    sentence = _FAULTS[fault].format(joint=who)
    return sentence[0].upper() + sentence[1:]


def describe_refusal(refusal: Refusal) -> str:
    """One sentence on what is wrong and what to do."""
    return _REFUSALS[refusal]

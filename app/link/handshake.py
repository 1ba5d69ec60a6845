"""Getting to know a board, and refusing one that does not fit."""

from __future__ import annotations

import secrets
from dataclasses import dataclass, replace

from app.link.board_geometry import BOARD_ROBOTS, geometry_hash, geometry_values, robot_from_geometry
from app.link.conversation import Script
from app.link.errors import LinkError
from app.link.protocol.codes import PROTOCOL_VERSION, BoardKind, Command, RobotKind
from app.link.protocol.messages import Ack, Get, Hello, Identity, Order, Set
from app.link.protocol.settings import GEOMETRY_ID, GEOMETRY_SIZE, setting_id
from app.robots import ROBOTS, Robot, build_robot
from app.simulation.run import SHOWN

BOARDS = {BoardKind.UNO: "Arduino Uno", BoardKind.STM32F407: "STM32F407", BoardKind.HOST: "emulated board"}
GEOMETRY_IDS = range(GEOMETRY_ID, GEOMETRY_ID + GEOMETRY_SIZE)
NO_SERIAL, HIGHEST_SERIAL = 0, 2**24 - 1
"""Of an Uno that was never connected; what a float of 4 bytes holds exactly."""
WIDER = 0.01
"""A board's joint limit may lie this far outside of the robot's (rad or m): rounding, and calibrated offsets."""


@dataclass(frozen=True, eq=False)
class Acquaintance:
    """What a handshake finds out."""

    identity: Identity
    robot: Robot
    """With the geometry that the board has."""
    settings: dict[int, float]
    """Those that were read on the way: limits and speeds of the joints, and the geometry."""


class Mismatch(LinkError):
    """The board is not what was expected; asking again gives the same."""


def shake_hands(wanted: str | None, before: Identity | None = None) -> Script[Acquaintance]:
    """Ask a board who it is. Mismatch where it does not fit.

    Args:
        wanted: name of the robot that it must have, with a geometry that the lab knows; None takes the board's own.
        before: the board that was here until the connection was lost; only that one is taken.
    """
    identity: Identity = yield Hello()
    check_version(identity)
    if before is not None:
        check_same_board(before, identity)
    name = robot_name(identity.robot)
    if wanted is not None and wanted != name:
        raise Mismatch(
            f"The board drives the robot {name}, not {wanted}: choose {name}, or flash the firmware for {wanted} with "
            "deltalab firmware upload."
        )
    known = known_robot(identity)
    settings: dict[int, float] = {}
    for id in (*limit_ids(identity.joints), *(() if known else GEOMETRY_IDS)):
        ack: Ack = yield Get(id)
        settings[id] = ack.value
    robot = known or own_robot(identity, settings, refuse=wanted is not None)
    check_limits(robot, settings)
    return Acquaintance(identity, robot, settings)


def limit_ids(joints: int) -> list[int]:
    return [setting_id(name, joint) for joint in range(joints) for name in ("min", "max", "speed")]


def robot_name(kind: RobotKind) -> str:
    return next(name for name, number in BOARD_ROBOTS.items() if number is kind)


def check_version(identity: Identity) -> None:
    if identity.protocol != PROTOCOL_VERSION:
        raise Mismatch(
            f"The board speaks version {identity.protocol} of the protocol and this program version "
            f"{PROTOCOL_VERSION}: flash its firmware again with deltalab firmware upload."
        )


def check_same_board(before: Identity, identity: Identity) -> None:
    numbers = {before.serial, identity.serial} - {NO_SERIAL}
    if (before.board, before.robot) != (identity.board, identity.robot) or len(numbers) > 1:
        raise Mismatch(
            f"This is another board: {describe(identity)} instead of {describe(before)}; plug the first one in again, "
            "or press Connect to use this one."
        )


def number_board(identity: Identity) -> Script[Identity]:
    """Give a number to a board whose processor has none, and let it keep it: the motors must be off."""
    number = 1 + secrets.randbelow(HIGHEST_SERIAL)
    yield Set(setting_id("serial"), float(number))
    yield Order(Command.SAVE)
    return replace(identity, serial=number)


def describe(identity: Identity) -> str:
    """`Arduino Uno 1000002 (delta3)`"""
    return f"{BOARDS[identity.board]} {identity.serial} ({robot_name(identity.robot)})"


def known_robot(identity: Identity) -> Robot | None:
    """The lab's robot with the geometry of the board, if it is one of the presets."""
    name = robot_name(identity.robot)
    presets = (build_robot(name, preset) for preset in ROBOTS[name].presets.values())
    return next((robot for robot in presets if geometry_hash(geometry_values(robot)) == identity.geometry), None)


def own_robot(identity: Identity, settings: dict[int, float], *, refuse: bool) -> Robot:
    """The robot that the board's own dimensions describe; refused where it describes none, or if `refuse`."""
    values = [settings[id] for id in GEOMETRY_IDS]
    if geometry_hash(values) != identity.geometry:
        raise Mismatch("The board's geometry does not fit its own checksum: flash it with deltalab firmware upload.")
    own = robot_from_geometry(identity.robot, values)
    if own is not None and not refuse:
        return own
    name = robot_name(identity.robot)
    raise Mismatch(
        f"The dimensions of the board's {name} ({identity.geometry:08x}) are not those of the lab's "
        f"({_known_hashes(name)}): {_differences(own)}"
    )


def _known_hashes(name: str) -> str:
    presets = ROBOTS[name].presets.items()
    return ", ".join(f"{title} {geometry_hash(geometry_values(build_robot(name, d))):08x}" for title, d in presets)


def _differences(own: Robot | None) -> str:
    if own is None:
        return "no robot of this kind has them; flash the board with deltalab firmware upload."
    default = build_robot(own.name, {}).geometry
    pairs = {name: (getattr(own.geometry, name), getattr(default, name)) for name in own.geometry.dimensions()}
    different = [
        f"{name} {1e3 * theirs:.1f} mm instead of {1e3 * ours:.1f}"
        for name, (theirs, ours) in pairs.items()
        if abs(theirs - ours) > 1e-6
    ]
    return f"{', '.join(different)}; choose the board's own dimensions, or flash it with deltalab firmware upload."


def check_limits(robot: Robot, settings: dict[int, float]) -> None:
    """A board may be stricter than its robot, never more generous."""
    unit, factor = SHOWN[robot.joint_unit]
    for joint, (low, high) in enumerate(robot.joint_limits.tolist()):
        theirs = settings[setting_id("min", joint)], settings[setting_id("max", joint)]
        if theirs[0] < low - WIDER or theirs[1] > high + WIDER:
            raise Mismatch(
                f"The board lets joint {joint + 1} go from {theirs[0] * factor:.1f} to {theirs[1] * factor:.1f} {unit}"
                f", but this {robot.name} only bears {low * factor:.1f} to {high * factor:.1f}: set its limits, or "
                "flash it with deltalab firmware upload."
            )

"""Reading a board's settings, and changing them with a check of what the board really keeps."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping

from app.link.board_geometry import robot_from_geometry
from app.link.conversation import Refused, Script
from app.link.errors import LinkError
from app.link.protocol.codes import Command, Refusal, RobotKind
from app.link.protocol.messages import Ack, Get, Order, Set
from app.link.protocol.settings import GEOMETRY_ID, GEOMETRY_SIZE, SETTING_COUNT, setting_of

SAME = 1e-6
"""Relative: a board keeps floats of 4 bytes."""


def read(ids: Iterable[int], note: Callable[[int, float], None]) -> Script[None]:
    """Read settings one by one; each goes to `note`."""
    for id in ids:
        ack: Ack = yield Get(id)
        note(id, ack.value)


def apply(values: Mapping[int, float], save: bool, note: Callable[[int, float], None]) -> Script[None]:
    """Set, read back and compare each of them. What the board refuses until others are set (limits the wrong way
    round) is tried again after them."""
    waiting = dict(values)
    while waiting:
        done = []
        refusal: Refused | None = None
        for id, value in waiting.items():
            try:
                yield Set(id, value)
            except Refused as refused:
                if refused.refusal is not Refusal.VALUE:
                    raise LinkError(f"{setting_title(id)} was not changed. {refused}") from None
                refusal = refused
                continue
            ack: Ack = yield Get(id)
            note(id, ack.value)
            check_kept(id, value, ack.value)
            done.append(id)
        if not done:
            raise LinkError(f"{setting_title(next(iter(waiting)))} was not changed. {refusal}")
        waiting = {id: value for id, value in waiting.items() if id not in done}
    if save:
        yield Order(Command.SAVE)


def check_kept(id: int, wanted: float, kept: float) -> None:
    if not math.isclose(wanted, kept, rel_tol=SAME, abs_tol=1e-9):
        raise LinkError(f"{setting_title(id)} should be {wanted:g}, but the board keeps {kept:g}; try it again.")


def check_values(values: Mapping[int, float], present: Mapping[int, float], robot: RobotKind) -> None:
    """Refuse what the board would be of no use with, before anything is sent."""
    for id, value in values.items():
        if not 0 <= id < SETTING_COUNT:
            raise LinkError(f"A board has no setting number {id}; they go from 0 to {SETTING_COUNT - 1}.")
        if not math.isfinite(value):
            raise LinkError(f"{setting_title(id)} must be a number; type one.")
    if max(values, default=0) < GEOMETRY_ID:
        return
    geometry = [values.get(id, present.get(id, 0.0)) for id in range(GEOMETRY_ID, GEOMETRY_ID + GEOMETRY_SIZE)]
    if robot_from_geometry(robot, geometry) is None:
        raise LinkError("No robot of this kind has that geometry; choose one of the lab's, or calibrate again.")


def setting_title(id: int) -> str:
    """`Proportional gain of joint 2`"""
    if id >= GEOMETRY_ID:
        return f"Number {id - GEOMETRY_ID + 1} of the geometry"
    setting, joint = setting_of(id)
    return setting.label if joint is None else f"{setting.label} of joint {joint + 1}"

"""A link in a terminal: waiting for it, and what it says in lines."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from concurrent.futures import TimeoutError as NoAnswer
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from app.errors import UserMistake

if TYPE_CHECKING:
    from app.link.lease import Person
    from app.link.link import RobotLink
    from app.link.status import LinkStatus
    from app.robots import Robot

LOOK_S = 0.02
ANSWER_S = 10.0


@contextmanager
def connected(port: str) -> Iterator[RobotLink]:
    """A link whose board is known; its failure to connect is a sentence."""
    from app.link.link import RobotLink

    link = RobotLink()
    try:
        answer(link.connect(port))
        yield link
    finally:
        link.close()


def answer(future: Future[Any]) -> Any:
    """What the link answers; a link that does not is a mistake with a sentence."""
    try:
        return future.result(ANSWER_S)
    except NoAnswer:
        raise UserMistake("The board does not answer; check the cable and try again.") from None


def wait_for(link: RobotLink, true: Callable[[LinkStatus], bool], within_s: float = ANSWER_S) -> LinkStatus:
    """The first status for which something holds."""
    end = time.monotonic() + within_s
    while time.monotonic() < end:
        status = link.status
        if true(status):
            return status
        if status.phase != "ready":
            break
        time.sleep(LOOK_S)
    raise UserMistake(link.status.sentence)


def stay_for(link: RobotLink, person: Person, true: Callable[[LinkStatus], bool], within_s: float) -> None:
    """Wait until something holds, with signs of life; a robot that cannot go on is a mistake with its sentence."""
    end = time.monotonic() + within_s
    while time.monotonic() < end:
        link.alive(person)
        if true(link.status):
            return
        if link.status.phase != "ready" or _is_unable(link.status):
            break
        time.sleep(LOOK_S)
    raise UserMistake(link.status.sentence)


def robot_of(link: RobotLink) -> Robot:
    robot = link.status.robot or wait_for(link, lambda now: now.robot is not None).robot
    assert robot is not None
    return robot


def describe(status: LinkStatus) -> Iterator[str]:
    """Lines about a board and its robot."""
    from app.link.handshake import BOARDS, robot_name
    from app.link.protocol.settings import setting_id
    from app.simulation.run import SHOWN

    identity, robot, telemetry = status.identity, status.robot, status.telemetry
    assert identity is not None and robot is not None and telemetry is not None
    unit, factor = SHOWN[robot.joint_unit]
    yield f"board     {BOARDS[identity.board]}, number {identity.serial}, firmware {identity.version}"
    yield f"robot     {robot_name(identity.robot)} ({robot.title}), geometry {identity.geometry:08x}"
    yield f"drives    {identity.drive.name.lower()}, {identity.joints} joints, control every {identity.period_us} us"
    yield f"settings  {identity.settings.name.lower().replace('_', ' ')}"
    yield f"state     {telemetry.state.name.lower()}, load {telemetry.load} %"
    for joint, name in enumerate(robot.joint_names):
        low, high, speed = (status.settings[setting_id(what, joint)] * factor for what in ("min", "max", "speed"))
        here = telemetry.position[joint] * factor
        yield f"{name:<10}{here:8.2f} {unit}   limits {low:.1f} to {high:.1f} {unit}, up to {speed:.0f} {unit}/s"


def position_line(status: LinkStatus) -> str:
    from app.simulation.run import SHOWN

    robot, telemetry = status.robot, status.telemetry
    if robot is None or telemetry is None:
        return status.sentence
    unit, factor = SHOWN[robot.joint_unit]
    joints = " ".join(f"{q * factor:8.2f}" for q in telemetry.position[: len(robot.joint_names)])
    return f"{telemetry.state.name.lower():<8} joints {joints} {unit}"


def state_of(status: LinkStatus) -> Any:
    return status.telemetry.state if status.telemetry is not None else None


def _is_unable(status: LinkStatus) -> bool:
    from app.link.protocol.codes import State

    return state_of(status) in (State.FAULT, State.STOPPED, State.HELD, State.OFF)

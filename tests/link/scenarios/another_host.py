"""A host in a process of its own, which moves the robot until it is killed: `python -m ... PORT`."""

from __future__ import annotations

import math
import sys
import time

from app.link.lease import Person
from app.link.link import RobotLink
from app.link.programs import Jog
from app.link.protocol.codes import Flag, State

ZOE = Person("zoe", "Zoe")


def main() -> None:
    link = RobotLink()
    link.connect(sys.argv[1])
    while link.status.phase != "ready":
        time.sleep(0.01)
    for deed in (link.request, link.enable, link.home):
        deed(ZOE).result(4.0)
    while not _home(link):
        time.sleep(0.01)
    start = _joint(link)
    jog = Jog("joint", 0, 1, math.radians(10.0))
    said = False
    while True:
        if link.status.telemetry and link.status.telemetry.state is State.HELD:
            link.jog_release(ZOE)  # this computer was busy: press anew
        link.jog(ZOE, jog)
        if not said and _joint(link) - start > math.radians(1.5):
            print("moving", flush=True)
            said = True
        time.sleep(0.05)


def _joint(link: RobotLink) -> float:
    """The first one, rad."""
    telemetry = link.status.telemetry
    return 0.0 if telemetry is None else telemetry.position[0]


def _home(link: RobotLink) -> bool:
    telemetry = link.status.telemetry
    return telemetry is not None and bool(telemetry.flags & Flag.HOMED) and telemetry.state == State.READY


if __name__ == "__main__":
    main()

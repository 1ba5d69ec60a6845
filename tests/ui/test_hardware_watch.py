"""The look at the link that all rooms share."""

from __future__ import annotations

import asyncio
from dataclasses import replace

import numpy as np

from app.link.protocol.codes import Fault, Flag, Refusal, State
from app.link.protocol.messages import Telemetry
from app.link.status import LinkStatus
from app.ui.hardware.history import LENGTH_S, History
from app.ui.hardware.watch import Watch


def telemetry(position: float, state: State = State.MOVING) -> Telemetry:
    four = (position, 0.0, 0.0, 0.0)
    return Telemetry(state, Flag.HOMED, Fault.NONE, 0, Refusal.OK, 0, 0, four, four, four, 0, 0, 0)


class Link:
    """Moves a little with every look, and counts the looks."""

    def __init__(self) -> None:
        self.looks = 0
        self.state = State.MOVING

    def read(self) -> LinkStatus:
        self.looks += 1
        return LinkStatus("ready", telemetry=telemetry(0.01 * self.looks, self.state), revision=self.looks)


def test_nobody_looks_unless_somebody_wants_to_know():
    async def scene() -> None:
        link = Link()
        watch = Watch(link.read)
        await asyncio.sleep(0.12)
        assert link.looks == 0
        heard: list[LinkStatus] = []
        leave = watch.attend(heard.append)
        await asyncio.sleep(0.4)
        leave()
        await asyncio.sleep(0.12)
        looks = link.looks
        assert len(heard) == looks >= 3
        await asyncio.sleep(0.2)
        assert link.looks == looks, "after the last one left it rests"
        watch.attend(heard.append)
        await asyncio.sleep(0.12)
        assert link.looks > looks

    asyncio.run(scene())


def test_a_motion_alone_is_no_news_but_a_state_is():
    async def scene() -> None:
        link = Link()
        watch = Watch(link.read)
        watch.attend(lambda _: None)
        await asyncio.sleep(0.25)
        edition = watch.edition
        await asyncio.sleep(0.25)
        assert watch.edition == edition
        link.state = State.STOPPED
        await asyncio.sleep(0.25)
        assert watch.edition == edition + 1

    asyncio.run(scene())


def test_one_rooms_trouble_is_not_the_others():
    async def scene() -> None:
        watch, heard = Watch(Link().read), []

        def fail(_: LinkStatus) -> None:
            raise RuntimeError("this room is broken")

        watch.attend(fail)
        watch.attend(heard.append)
        await asyncio.sleep(0.25)
        assert len(heard) >= 2

    asyncio.run(scene())


def test_the_history_is_thinned_and_ends_now():
    history = History()
    for k in range(3000):
        history.append(replace(telemetry(0.001 * k), t_us=k), 1000.0 + 0.02 * k)
    t, position, _, _ = history.columns
    assert t[-1] == 0.0 and -LENGTH_S - 0.2 <= t[0] <= -LENGTH_S + 0.2
    assert len(t) <= LENGTH_S / 0.1 + 2 and (np.diff(t) > 0.0).all()
    np.testing.assert_allclose(position[:, 0], position[-1, 0] + 0.05 * t, atol=1e-9)
    history.clear()
    assert len(history.columns[0]) == 0

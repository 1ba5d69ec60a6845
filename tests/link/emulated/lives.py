"""Random lives for a board: what the host sends, what breaks, and how time passes; weighted towards what happens."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

from hypothesis import strategies as st

from app.link.emulated.faults import Faults
from app.link.protocol.codes import Command, Flag, State, TargetKind, TestKind
from app.link.protocol.frames import encode_frame
from app.link.protocol.messages import Alive, Get, Hello, Order, Set, Setpoint, Test, pack
from app.link.protocol.settings import setting_id
from tests.link.emulated.two_cores import TwoCores

Event: TypeAlias = Callable[[TwoCores], None]

LONGEST_HOMING = 2000
"""Periods"""

joint = st.integers(0, 3)
share = st.floats(-1.0, 1.0, width=32)
direction = st.floats(0.125, 1.0, width=32) | st.floats(-1.0, -0.125, width=32)
"""Not 0: whether a target is exactly where the set-point is depends on rounding."""


def ready(life: TwoCores) -> None:
    """On, homed, at rest."""
    life.faults = Faults()
    for command in (Command.OFF, Command.CLEAR, Command.ENABLE, Command.HOME):
        life.run(2)
        life.send(Order(command))
    for _ in range(LONGEST_HOMING // 4):
        life.send(Alive())
        life.run(4)
        seen = life.telemetry
        if seen and seen.state == State.READY and seen.flags & Flag.HOMED:
            life.run(30)
            return


def waits(periods: int, dt_us: int) -> Event:
    return lambda life: life.run(periods, dt_us)


def lives_on(periods: int) -> Event:
    def event(life: TwoCores) -> None:
        for _ in range(periods):
            life.send(Alive())
            life.run(3)

    return event


def commands(command: Command) -> Event:
    return lambda life: life.send(Order(command))


def streams(steps: int, way: tuple[float, ...], size: float, pose: bool, manual: bool, laser: int, pause: int) -> Event:
    """Set-points along a line from where the robot is, as a host sends them."""

    def event(life: TwoCores) -> None:
        start = life.telemetry.setpoint if life.telemetry else (0.0,) * 4
        here = life.robot.forward(start[: len(life.robot.joint_names)]).tolist() if pose else list(start)
        kind = TargetKind.POSE if pose else TargetKind.JOINTS
        for step in range(1, steps + 1):
            target = tuple(a + size * step * b for a, b in zip(here, way, strict=False))
            if all(map(math.isfinite, target)):
                life.send(Setpoint(kind, target, manual, laser > 200, laser))
            life.run(pause)

    return event


def targets(kind: TargetKind, target: tuple[float, ...], manual: bool) -> Event:
    return lambda life: life.send(Setpoint(kind, target, manual))


def tests_joint(kind: TestKind, number: int, amplitude: float, duration_ms: int) -> Event:
    def event(life: TwoCores) -> None:
        life.send(Test(kind, number, amplitude, duration_ms))
        lives_on(8)(life)

    return event


def breaks(**fault: object) -> Event:
    def event(life: TwoCores) -> None:
        life.faults = replace(life.faults, **fault)  # type: ignore[arg-type]
        life.run(3)

    return event


def changes(id: int, value: float) -> Event:
    def event(life: TwoCores) -> None:
        life.send(Set(id, value))
        life.send(Get(id))
        life.run(1)

    return event


def noise(data: bytes) -> Event:
    return lambda life: life.send_bytes(data)


def strange(payload: bytes) -> Event:
    """A whole frame of any content; what would be a SET has its own event."""
    return lambda life: life.send_bytes(encode_frame(payload)) if payload[0] not in (3, 5, 7) else None


def spoils(at: int, byte: int) -> Event:
    def event(life: TwoCores) -> None:
        frame = bytearray(encode_frame(pack(Order(Command.STOP), 9)))
        frame[at % len(frame)] = byte
        life.send_bytes(bytes(frame))

    return event


likely_settings = st.sampled_from([
    (setting_id("kp", 0), 20.0), (setting_id("ki", 1), 0.0), (setting_id("n", 2), 0.0), (setting_id("kd", 0), 0.5),
    (setting_id("max", 1), 0.3), (setting_id("min", 0), 0.1), (setting_id("home", 2), 0.2),
    (setting_id("speed", 0), 0.5), (setting_id("tool_speed"), 0.05), (setting_id("hold_after"), 40.0),
    (setting_id("off_after"), 250.0), (setting_id("jump"), 0.05), (setting_id("following"), 0.02),
    (setting_id("following_time"), 0.0), (setting_id("home_speed"), 0.9), (setting_id("serial"), 4712.0),
    (setting_id("pen_up"), 1000.0), (setting_id("stop_time"), 75.0), (setting_id("duty_max"), 0.4), (53, 0.21),
])  # fmt: skip
numbers = st.floats(width=32) | st.sampled_from([0.0, 1.0, -1.0, 1e-3, 30.0, 300.0])

events: st.SearchStrategy[Event] = st.one_of(
    st.just(ready),
    st.builds(waits, st.integers(1, 60), st.sampled_from([5000, 5000, 5000, 4000, 7000, 45_000])),
    st.builds(lives_on, st.integers(1, 30)),
    st.builds(commands, st.sampled_from(Command)),
    *(
        st.builds(
            streams,
            st.integers(1, 12),
            st.tuples(direction, direction, direction, direction),
            st.sampled_from([1e-4, 1e-3, 4e-3, 2e-2]),
            st.booleans(),
            st.booleans(),
            st.sampled_from([0, 100, 255]),
            st.integers(1, 9),
        )
        for _ in range(3)
    ),
    st.builds(targets, st.sampled_from(TargetKind), st.tuples(numbers, numbers, numbers, numbers), st.booleans()),
    st.builds(tests_joint, st.sampled_from(TestKind), joint, share, st.sampled_from([0, 20, 60, 200, 6000])),
    st.builds(lambda number: breaks(stuck_joint=number), st.none() | joint),
    st.builds(lambda number: breaks(limit_switch=number), st.none() | joint),
    st.builds(lambda number: breaks(sensor_broken=number), st.none() | joint),
    st.builds(lambda pressed: breaks(estop=pressed), st.booleans()),
    likely_settings.map(lambda pair: changes(*pair)),
    st.builds(changes, st.integers(0, 255), numbers),
    st.builds(noise, st.binary(max_size=80)),
    st.builds(strange, st.binary(min_size=3, max_size=56)),
    st.builds(spoils, st.integers(0, 99), st.integers(0, 255)),
    st.just(lambda life: life.send(Hello())),
)
lives = st.lists(events, min_size=3, max_size=25)

"""Steps are counted, spread evenly, and never too quick for a driver."""

from __future__ import annotations

import ctypes
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from tests.support.emulators.stm32.drivers import Drivers, floats
from tests.support.emulators.stm32.firmware import needs_drivers

pytestmark = needs_drivers

INTERRUPTS_PER_MS = 50
DECISIONS = 25


class Axis(ctypes.Structure):
    _fields_ = (
        ("made", ctypes.c_int32),
        ("target", ctypes.c_int32),
        ("phase", ctypes.c_uint32),
        ("rate", ctypes.c_uint32),
        ("direction", ctypes.c_int8),
    )


@given(st.lists(st.integers(-DECISIONS, DECISIONS), min_size=1, max_size=20))
def test_every_period_ends_where_it_should(compiled_drivers, moves):
    axis, target = Axis(), 0
    for move in moves:
        target += move
        steps = decide(compiled_drivers, axis, target)
        # an overflow may fall one decision late, into the period after
        assert abs(axis.made - target) <= 1
        assert sum(steps) <= abs(move) + 1
    decide(compiled_drivers, axis, target)
    decide(compiled_drivers, axis, target)
    assert axis.made == target


@given(st.integers(1, DECISIONS - 1))
def test_steps_are_spread_evenly(compiled_drivers, move):
    steps = decide(compiled_drivers, Axis(), move)
    at = [i for i, step in enumerate(steps) if step]
    gaps = {after - before for before, after in pairwise(at)}
    assert len(at) == move
    assert not gaps or max(gaps) - min(gaps) <= 1


def decide(drivers: Drivers, axis: Axis, target: int) -> list[int]:
    """One period of one axis."""
    drivers.library.step_axis_aim(ctypes.byref(axis), target, DECISIONS)
    return [drivers.library.step_axis_decide(ctypes.byref(axis)) for _ in range(DECISIONS)]


def test_pulses_on_the_pins_are_as_many_as_the_steps_and_wide_enough(drivers):
    drivers.call("steppers_start")
    start = made(drivers)
    assert drivers.pin("D", 11) == 1  # the drivers are disabled
    levels = run(drivers, [start[0] + 10, start[1] - 7, start[2], start[3] + 25])
    assert drivers.pin("D", 11) == 0
    assert [rises(levels, j) for j in range(4)] == [10, 7, 0, 25]
    assert [drivers.pin("D", 6 + j) for j in (0, 1, 3)] == [1, 0, 1]
    assert made(drivers) == [start[0] + 10, start[1] - 7, start[2], start[3] + 25]
    assert all(not (now & after) for now, after in pairwise(levels))  # 20 us each


def test_no_power_no_steps(drivers):
    drivers.call("steppers_start")
    start = made(drivers)
    assert not any(run(drivers, [steps + 20 for steps in start], powered=0))
    assert made(drivers) == start
    assert drivers.pin("D", 11) == 1


def run(drivers: Drivers, targets: list[float], powered: int = 1) -> list[int]:
    """One control period: the four step pins after each interrupt."""
    drivers.library.steppers_write(powered, floats(targets))
    levels = []
    for _ in range(INTERRUPTS_PER_MS):
        drivers.call("TIM7_IRQHandler")
        levels.append(sum(drivers.pin("D", j) << j for j in range(4)))
    return levels


def rises(levels: list[int], joint: int) -> int:
    bits = [level >> joint & 1 for level in [0, *levels]]
    return sum(after > before for before, after in pairwise(bits))


def made(drivers: Drivers) -> list[float]:
    steps = floats([0.0] * 4)
    drivers.library.steppers_read(steps)
    return list(steps)

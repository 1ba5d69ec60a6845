"""Register values, against the formulas and limits of ST's reference manual RM0090 and data sheet."""

from __future__ import annotations

import ctypes

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.support.emulators.stm32.drivers import Drivers
from tests.support.emulators.stm32.firmware import needs_drivers

pytestmark = needs_drivers


def test_the_divider_of_the_serial_line(compiled_drivers):
    divider = compiled_drivers.call("host_usart_divider", 42_000_000, 115_200)
    assert divider == 365
    mantissa, fraction = divider >> 4, divider & 15
    baud = 42e6 / (16 * (mantissa + fraction / 16))
    assert baud == pytest.approx(115_200, rel=0.002)


@given(st.sampled_from([8_000_000, 16_000_000, 42_000_000, 84_000_000]), st.sampled_from([9600, 57600, 115200, 460800]))
def test_no_other_divider_comes_closer(compiled_drivers, clock_hz, baud):
    divider = compiled_drivers.call("host_usart_divider", clock_hz, baud)
    error = [abs(1.0 / baud - tried / clock_hz) for tried in (divider, divider - 1, divider + 1)]
    assert error[0] <= min(error)


def test_the_watchdog_waits_60_ms_and_never_less_than_three_dozen(compiled_drivers):
    counts = compiled_drivers.call("host_watchdog_reload", 60) + 1
    assert counts <= 4096
    assert 4 * counts / 32e3 == pytest.approx(0.060)
    assert 4 * counts / 47e3 > 0.036  # the quickest oscillator that the data sheet allows
    assert 4 * counts / 17e3 < 0.200  # the slowest one


@given(st.floats(0.0, 1.0), st.sampled_from([4199, 8399, 19999]))
def test_a_share_of_the_period(compiled_drivers, share, reload):
    compare = compare_for(compiled_drivers, share, reload)
    assert abs(compare / (reload + 1) - share) <= 0.51 / (reload + 1)


@pytest.mark.parametrize(("share", "compare"), [(-0.1, 0), (0.0, 0), (float("nan"), 0), (1.0, 8400), (7.0, 8400)])
def test_the_ends_of_a_period(compiled_drivers, share, compare):
    assert compare_for(compiled_drivers, share, 8399) == compare  # above the reload value: never low


def compare_for(drivers: Drivers, share: float, reload: int) -> int:
    return drivers.library.host_compare_for(ctypes.c_float(share), ctypes.c_uint32(reload))

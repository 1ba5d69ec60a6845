"""What the drivers write into the registers, read at the addresses and bits of ST's reference manual RM0090."""

from __future__ import annotations

import ctypes

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.support.emulators.stm32.drivers import ALTERNATE, ANALOG, OUTPUT, Drivers, Inputs, floats
from tests.support.emulators.stm32.firmware import needs_drivers

pytestmark = needs_drivers

RCC, FLASH = 0x4002_3800, 0x4002_3C00
TIM1, TIM3, TIM4, TIM5 = 0x4001_0000, 0x4000_0400, 0x4000_0800, 0x4000_0C00
USART2, ADC1, IWDG = 0x4000_4400, 0x4001_2000, 0x4000_3000
PSC, ARR, CCER, BDTR = 0x28, 0x2C, 0x20, 0x44
MOE = 1 << 15


def ccr(channel: int) -> int:
    return 0x34 + 4 * (channel - 1)


@pytest.mark.parametrize(("crystal", "source_hz"), [(True, 8e6), (False, 16e6)])
def test_the_clock_is_168_mhz_with_and_without_a_crystal(drivers, crystal, source_hz):
    drivers.write(RCC, 0x83 | crystal << 17 | 1 << 25)  # oscillators ready
    drivers.call("chip_start")
    pll, buses = drivers.read(RCC + 4), drivers.read(RCC + 8)
    m, n, p = pll & 0x3F, pll >> 6 & 0x1FF, 2 * (pll >> 16 & 3) + 2
    assert (pll >> 22 & 1) == crystal
    assert 1e6 <= source_hz / m <= 2e6
    assert source_hz / m * n / p == 168e6
    assert buses & 3 == 2  # the PLL is the clock
    assert buses >> 10 & 7 == 0b101 and buses >> 13 & 7 == 0b100  # APB1 by 4: 42 MHz, APB2 by 2: 84 MHz
    assert drivers.read(FLASH) & 7 == 5  # wait states for 150 to 168 MHz at 3.3 V
    assert drivers.read(TIM5 + PSC) == 83 and drivers.read(TIM5 + ARR) == 0xFFFF_FFFF


def test_a_chip_without_clocks_is_an_emulator(drivers):
    drivers.call("chip_start")
    assert drivers.read(TIM5 + PSC) == 999
    assert drivers.read(FLASH) == 0


@pytest.mark.parametrize(
    ("flags", "cause"),
    [(1 << 27 | 1 << 26 | 1 << 25, 0), (1 << 26, 1), (1 << 26 | 1 << 28, 1), (1 << 26 | 1 << 29, 2), (1 << 30, 2)],
)
def test_why_it_started(drivers, flags, cause):
    drivers.write(RCC + 0x74, flags)
    assert drivers.call("reset_cause") == cause
    assert drivers.read(RCC + 0x74) >> 24 & 1  # the flags are cleared


@given(st.binary(min_size=12, max_size=12))
def test_the_serial_number_is_a_hash_that_a_float_can_hold(compiled_drivers, chip):
    for word in range(3):
        compiled_drivers.write(0x1FFF_7A10 + 4 * word, int.from_bytes(chip[4 * word : 4 * word + 4], "little"))
    wanted = 0x811C_9DC5
    for byte in chip:
        wanted = (wanted ^ byte) * 0x0100_0193 & 0xFFFF_FFFF
    found = compiled_drivers.call("chip_serial")
    assert found == ((wanted >> 24 ^ wanted) & 0xFF_FFFF or 1)
    assert ctypes.c_float(found).value == found


def test_the_watchdog_is_set_to_60_ms(drivers):
    drivers.call("watchdog_start")
    assert drivers.read(IWDG + 4) == 0  # by 4
    assert drivers.read(IWDG + 8) == 479


def test_the_serial_line(drivers):
    drivers.call("usart_start")
    assert drivers.read(USART2 + 8) == 0x16D
    assert drivers.read(USART2 + 12) == 1 << 13 | 1 << 5 | 1 << 3 | 1 << 2
    for pin in (2, 3):
        assert drivers.pin_mode("A", pin) == ALTERNATE and drivers.pin_function("A", pin) == 7


def test_bytes_come_in_and_an_overrun_does_no_harm(drivers):
    arrived = []
    for byte, status in [(0x55, 1 << 5), (0x00, 1 << 3), (0xAA, 1 << 5 | 1 << 3)]:
        drivers.write(USART2 + 4, byte)
        drivers.write(USART2, status)
        drivers.call("USART2_IRQHandler")
    while (byte := drivers.library.usart_read()) >= 0:
        arrived.append(byte)
    assert arrived == [0x55, 0xAA]


def test_a_frame_goes_out_whole_or_not_at_all(drivers):
    drivers.write(USART2, 0)  # the transmitter is busy
    frame = bytes(range(1, 62))
    taken = [drivers.library.usart_write(frame, len(frame)) for _ in range(5)]
    assert taken == [1, 1, 1, 1, 0]
    assert drivers.read(USART2 + 12) >> 7 & 1
    assert not drivers.library.usart_idle()
    drivers.write(USART2, 1 << 7)
    drivers.call("USART2_IRQHandler")
    assert drivers.read(USART2 + 4) == 61
    assert drivers.library.usart_idle()
    assert not drivers.read(USART2 + 12) >> 7 & 1


def test_the_converter_reads_its_four_channels(drivers):
    drivers.call("sensors_start")
    sequence = drivers.read(ADC1 + 0x38)
    assert sequence >> 20 == 3  # four of them
    assert [sequence >> 5 * i & 31 for i in range(4)] == [8, 9, 11, 12]
    assert drivers.read(ADC1 + 0x10) == 4 << 24 | 4 << 27 and drivers.read(ADC1 + 0x0C) == 4 << 3 | 4 << 6
    assert all(drivers.pin_mode(port, pin) == ANALOG for port, pin in [("B", 0), ("B", 1), ("C", 1), ("C", 2)])
    for channel, value in enumerate([0, 4095, 1365, 2048]):
        drivers.write(ADC1 + 0x3C + 4 * channel, value)
    assert sensors(drivers) == pytest.approx([0.0, 1.0, 1 / 3, 2048 / 4095])


def test_a_converter_that_does_not_answer_reads_as_a_broken_wire(drivers):
    drivers.call("sensors_start")
    drivers.write(ADC1 + 8, 0)  # without power
    for channel in range(4):
        drivers.write(ADC1 + 0x3C + 4 * channel, 2048)
    assert sensors(drivers) == [0.0] * 4


def sensors(drivers: Drivers) -> list[float]:
    raw = floats([-1.0] * 4)
    drivers.library.sensors_read(raw)
    return list(raw)


def test_the_bridges(drivers):
    drivers.call("bridges_start")
    assert 168e6 / (drivers.read(TIM1 + PSC) + 1) / (drivers.read(TIM1 + ARR) + 1) == 20e3
    assert drivers.read(TIM1 + BDTR) & (3 << 12) == 3 << 12  # the break input works, and high breaks
    assert drivers.read(TIM1 + BDTR) & (3 << 10) == 3 << 10  # and then the pins are held
    assert not drivers.read(TIM1 + BDTR) & MOE
    drivers.library.bridges_write(1, floats([0.5, -0.25, 0.0, 1.0]))
    assert bridges(drivers) == [(4200, 1, 0), (2100, 0, 1), (0, 0, 0), (8400, 1, 0)]
    assert drivers.read(TIM1 + BDTR) & MOE
    assert all(drivers.pin_function("E", pin) == 1 for pin in (9, 11, 13, 14))
    drivers.library.bridges_write(0, floats([0.5, -0.25, 0.0, 1.0]))
    assert bridges(drivers) == [(0, 0, 0)] * 4
    assert not drivers.read(TIM1 + BDTR) & MOE


def bridges(drivers: Drivers) -> list[tuple[int, int, int]]:
    """Duty, and the two directions."""
    return [(drivers.read(TIM1 + ccr(j + 1)), drivers.pin("D", j), drivers.pin("D", 6 + j)) for j in range(4)]


def test_pen_and_laser(drivers):
    drivers.call("pen_laser_start")
    assert 84e6 / (drivers.read(TIM3 + PSC) + 1) == 1e6 and drivers.read(TIM3 + ARR) == 19_999
    assert 84e6 / (drivers.read(TIM4 + PSC) + 1) / (drivers.read(TIM4 + ARR) + 1) == 5e3
    assert drivers.read(TIM3 + CCER) == 1 << 4 and drivers.read(TIM4 + CCER) == 1 << 8  # channels 2 and 3
    assert drivers.pin_function("B", 5) == drivers.pin_function("B", 8) == 2
    for laser, compare in [(0.0, 0), (0.5, 2100), (1.0, 4200)]:
        drivers.library.pen_laser_write(ctypes.c_float(1500.4), ctypes.c_float(laser))
        assert drivers.read(TIM4 + ccr(3)) == compare
    assert drivers.read(TIM3 + ccr(2)) == 1500
    drivers.library.pen_laser_write(ctypes.c_float(0.0), ctypes.c_float(0.0))
    assert drivers.read(TIM3 + ccr(2)) == 0


def test_switches_and_emergency_stop(drivers):
    drivers.call("board_start")
    assert all(drivers.pin_pulled_up("B", pin) for pin in range(12, 16)) and drivers.pin_pulled_up("E", 15)
    assert drivers.pin_function("E", 15) == 1  # TIM1's break input
    for port_b, port_e, switches, stopped in [(0xFFFF, 0, 0, 0), (0xAFFF, 1 << 15, 0b0101, 1)]:
        drivers.set_inputs("B", port_b)
        drivers.set_inputs("E", port_e)
        found = Inputs()
        drivers.library.board_read(ctypes.byref(found))
        assert (found.limit_switches, found.estop_open) == (switches, stopped)


def test_a_fault_of_the_processor_leaves_no_power(drivers):
    drivers.call("board_start")
    drivers.library.bridges_write(1, floats([1.0] * 4))
    drivers.library.pen_laser_write(ctypes.c_float(1500.0), ctypes.c_float(1.0))
    drivers.call("board_off")
    assert bridges(drivers) == [(0, 0, 0)] * 4
    assert drivers.read(TIM4 + ccr(3)) == 0
    assert drivers.pin("D", 10) == 0 and drivers.pin_mode("D", 10) == OUTPUT

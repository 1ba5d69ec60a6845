"""The hardware watchdog, resets of every kind, and what outlasts them."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from app.link.protocol.codes import Command, Fault, Flag, Refusal, Reset, SettingsSource, State
from app.link.protocol.messages import Order, Set
from tests.support.emulators.uno.build import needs_uno
from tests.support.emulators.uno.plants import HOME_RAD, POWER
from tests.support.emulators.uno.rig import Rig

pytestmark = needs_uno
NewRig = Callable[..., Rig]
KP_0 = 0
SAVING_S = 0.5
"""More than enough: simavr burns a byte at once, a real Uno takes 3.4 ms for each of 306."""


@pytest.mark.parametrize("interrupts", [True, False])
def test_a_hang_ends_in_a_reset_and_a_fault(new_rig: NewRig, interrupts: bool) -> None:
    rig = new_rig("delta3_dc")
    rig.make_ready()
    rig.follow(lambda t: (HOME_RAD + t,) * 3, 0.1)
    rig.uno.hang(interrupts)
    assert 0.02 < rig.until(lambda: rig.uno.resets == 1, 0.2) < 0.08
    rig.run(0.05)
    assert not rig.uno.level(POWER)
    assert (rig.telemetry.state, rig.telemetry.fault) == (State.FAULT, Fault.WATCHDOG)
    assert rig.identify().reset == Reset.WATCHDOG
    assert rig.order(Command.ENABLE) == Refusal.FAULT
    assert rig.order(Command.CLEAR) == Refusal.OK
    rig.wait_for(State.OFF)
    rig.run(0.3)
    assert rig.uno.resets == 1  # no circle of resets


def test_a_hang_is_told_apart_where_the_bootloader_hides_it(new_rig: NewRig) -> None:
    rig = new_rig("delta3_servo")
    rig.uno.clear_reset_cause()
    rig.run(0.1)
    rig.uno.hang()
    rig.until(lambda: rig.uno.resets == 1, 0.2)
    rig.run(0.05)
    assert rig.identify().reset == Reset.WATCHDOG
    rig.uno.reset(boot_ms=5)
    rig.run(0.05)
    assert rig.identify().reset == Reset.LINE
    assert rig.telemetry.fault == Fault.NONE


def test_a_reset_on_the_line_leaves_it_off_and_not_homed(new_rig: NewRig) -> None:
    rig = new_rig("delta3_servo")
    rig.make_ready()
    assert rig.uno.level(POWER)
    rig.uno.reset(boot_ms=20)
    rig.run(0.06)
    assert not rig.uno.level(POWER)
    assert rig.identify().reset == Reset.LINE
    assert (rig.telemetry.state, rig.telemetry.flags) == (State.OFF, Flag(0))
    assert rig.telemetry.limit_switches == 0


def test_saved_settings_outlast_resets_and_power_cuts(new_rig: NewRig) -> None:
    rig = new_rig("delta3_dc")
    assert rig.set(KP_0, 12.5) == Refusal.OK
    rig.uno.reset()
    rig.run(0.03)
    assert rig.get(KP_0) != 12.5  # it was not saved

    assert rig.set(KP_0, 12.5) == rig.order(Command.SAVE) == Refusal.OK
    rig.run(SAVING_S)
    assert rig.missed_ticks == 0
    rig.uno.reset()
    rig.run(0.03)
    assert rig.get(KP_0) == 12.5
    assert rig.identify().settings == SettingsSource.STORED

    after_power_cut = new_rig("delta3_dc", eeprom=rig.uno.eeprom)
    after_power_cut.run(0.03)
    assert after_power_cut.get(KP_0) == 12.5
    assert after_power_cut.identify().reset == Reset.POWER


def test_a_setting_changed_while_it_saves_leaves_the_memory_sound(new_rig: NewRig) -> None:
    rig = new_rig("delta3_servo")
    rig.send(Order(Command.SAVE))
    rig.send(Set(KP_0, 3.0))  # 1.6 ms later: the first bytes are burnt, the last not yet
    rig.run(SAVING_S)
    rig.uno.reset()
    rig.run(0.03)
    assert rig.identify().settings == SettingsSource.STORED
    assert rig.get(KP_0) == 3.0


def test_damaged_memory_is_not_believed(new_rig: NewRig) -> None:
    rig = new_rig("delta3_dc")
    built_in = rig.get(KP_0)
    assert rig.set(KP_0, 12.5) == rig.order(Command.SAVE) == Refusal.OK
    rig.run(SAVING_S)
    damaged = bytearray(rig.uno.eeprom)
    damaged[1] ^= 0x10
    other = new_rig("delta3_dc", eeprom=bytes(damaged))
    other.run(0.03)
    assert other.identify().settings == SettingsSource.DAMAGED
    assert other.get(KP_0) == built_in

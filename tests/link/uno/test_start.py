"""What an Uno is and does before anybody asks it to move."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from app.link.protocol.codes import (
    BoardKind,
    DriveKind,
    Flag,
    Refusal,
    Reset,
    RobotKind,
    SettingsSource,
    State,
    TargetKind,
)
from app.link.protocol.messages import Setpoint
from tests.support.emulators.uno.build import VARIANTS, needs_uno
from tests.support.emulators.uno.plants import LASER, PEN, POWER, PWM, SERVOS, WAY
from tests.support.emulators.uno.rig import Rig

pytestmark = needs_uno
NewRig = Callable[..., Rig]
KINDS = {
    "delta3_servo": (RobotKind.DELTA3, DriveKind.SERVO),
    "delta3_dc": (RobotKind.DELTA3, DriveKind.DC),
    "linear_stepper": (RobotKind.LINEAR, DriveKind.STEPPER),
}


@pytest.mark.parametrize("variant", VARIANTS)
def test_it_says_what_it_is(new_rig: NewRig, variant: str) -> None:
    identity = new_rig(variant).identify()
    assert (identity.protocol, identity.board) == (1, BoardKind.UNO)
    assert (identity.robot, identity.drive) == KINDS[variant]
    assert (identity.joints, identity.period_us) == (3, 5000)
    assert (identity.reset, identity.settings) == (Reset.POWER, SettingsSource.BUILT_IN)


@pytest.mark.parametrize("variant", VARIANTS)
def test_it_boots_without_power_and_moves_nothing(new_rig: NewRig, variant: str) -> None:
    rig = new_rig(variant)
    before = list(rig.plant.joints)
    for _ in range(20):
        rig.send(Setpoint(TargetKind.JOINTS, (0.3, 0.3, 0.3), manual=True, laser=255))
        rig.run(0.01)
    told = rig.telemetry
    assert (told.state, told.flags, told.refusal) == (State.OFF, Flag(0), Refusal.NOT_ENABLED)
    assert rig.plant.joints == before
    assert rig.uno.level(POWER) == (variant == "linear_stepper")  # the drivers' enable works upside down
    assert rig.uno.pwm(LASER) == 0.0
    quiet = SERVOS if variant == "delta3_servo" else (*PWM, *WAY)
    assert [rig.uno.rises(pin) for pin in quiet] == [0] * len(quiet)


def test_the_pen_is_lifted_from_the_start(new_rig: NewRig) -> None:
    rig = new_rig("delta3_dc")
    rises = rig.uno.rises(PEN)
    rig.run(0.2)
    assert rig.uno.rises(PEN) - rises == 10
    assert rig.uno.pulse_us(PEN) == pytest.approx(1300, abs=10)


def test_telemetry_comes_every_20_ms(new_rig: NewRig) -> None:
    rig = new_rig("delta3_servo")
    rig.run(1.05)
    spacing_us = np.diff([told.t_us for told in rig.all_telemetry])
    assert len(spacing_us) >= 49
    np.testing.assert_allclose(spacing_us, 20_000, atol=100)


def test_two_runs_are_the_same_byte_by_byte(new_rig: NewRig) -> None:
    def run() -> tuple[object, list[float]]:
        rig = new_rig("delta3_dc")
        rig.make_ready()
        rig.follow(lambda t: (0.16 + t, 0.16, 0.16 - t), 0.2)
        return rig.heard, rig.plant.joints

    assert run() == run()

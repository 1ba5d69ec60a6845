"""Whether 16 MHz and a 64-byte buffer are enough."""

from __future__ import annotations

import math
import random
from collections.abc import Callable

import pytest

from app.link.protocol.codes import State, TargetKind
from app.link.protocol.messages import Setpoint
from app.robots import make_robot
from tests.support.emulators.uno.build import VARIANTS, needs_uno
from tests.support.emulators.uno.rig import Rig

pytestmark = needs_uno
NewRig = Callable[..., Rig]
STEP_S = 0.01


def test_ten_thousand_bytes_of_noise_miss_no_tick(new_rig: NewRig) -> None:
    noise, rig = random.Random(5), new_rig("delta3_dc")
    rig.make_ready()
    home = rig.telemetry.setpoint[:3]
    good, bad = rig.telemetry.good, rig.telemetry.bad
    for k in range(150):
        rig.uno.send(noise.randbytes(67))  # with the set-point the line is full
        rig.send(Setpoint(TargetKind.JOINTS, tuple(q + 0.3 * math.sin(3 * STEP_S * k) for q in home)))
        rig.run(STEP_S)
    told = rig.telemetry
    assert rig.missed_ticks == 0
    assert told.state == State.MOVING
    assert told.bad - bad >= 100
    assert told.good - good >= 145
    assert rig.decoder.bad == 0
    # A processor that never looks at the line would not have heard the last one.
    assert told.setpoint[0] == pytest.approx(home[0] + 0.3 * math.sin(3 * STEP_S * 147), abs=0.03)


@pytest.mark.parametrize("kind", TargetKind)
@pytest.mark.parametrize("variant", VARIANTS)
def test_moves_by_hand_at_100_hz_miss_no_tick_and_the_load_is_told(
    new_rig: NewRig, variant: str, kind: TargetKind
) -> None:
    robot = make_robot("linear" if variant == "linear_stepper" else "delta3")
    x, y, z = robot.home[:3].tolist()
    rig = new_rig(variant)
    rig.make_ready()
    slept_us, begin_us = rig.uno.slept_us, rig.uno.now_us
    for k in range(120):
        angle = 3 * STEP_S * k
        pose = x + 0.02 * (math.cos(angle) - 1), y + 0.02 * math.sin(angle), z + 0.01 * math.sin(angle)
        target = pose if kind == TargetKind.POSE else tuple(robot.inverse(pose).tolist())
        rig.send(Setpoint(kind, target, manual=True, laser=1))
        rig.run(STEP_S)
    assert rig.telemetry.state == State.MOVING
    assert rig.missed_ticks == 0
    true_load = 1.0 - (rig.uno.slept_us - slept_us) / (rig.uno.now_us - begin_us)
    assert rig.telemetry.load / 100 == pytest.approx(true_load, abs=0.06)
    assert true_load < 0.99

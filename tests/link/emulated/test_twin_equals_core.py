"""The Python twin of the firmware's core lives every life as the C does."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from app.link.protocol.codes import DriveKind, Flag, Reset
from app.link.protocol.messages import Ack, Get, Hello, Identity, Sample, Set
from app.link.protocol.settings import setting_id
from tests.link.emulated.lives import Event, lives, lives_on, ready, streams
from tests.link.emulated.two_cores import TwoCores, close, differing
from tests.support.tools import needs

pytestmark = needs("gcc")

BUILDS = [
    ("par4", DriveKind.DC),
    ("delta3", DriveKind.SERVO),
    ("delta3", DriveKind.DC),
    ("linear", DriveKind.STEPPER),
    ("fivebar", DriveKind.DC),
]
ROUNDING = 3e-5
"""rad or m: floats of 4 bytes against those of 8, over a life."""
MANUAL = 2e-3
"""The speed of the tool is found from small differences of its pose, of which rounding is a percent."""

UNSHRUNK = (Phase.explicit, Phase.reuse, Phase.generate)
"""A life takes a tenth of a second: shrinking one takes minutes."""


@pytest.mark.parametrize(("robot", "drive"), BUILDS)
@settings(max_examples=12, phases=UNSHRUNK, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
@given(st.booleans(), lives)
def test_both_live_alike(robot: str, drive: DriveKind, from_ready: bool, events: list[Event]):
    life = TwoCores(robot, drive)
    for event in [ready, *events] if from_ready else events:
        event(life)
    life.run(8)
    assert_alike(life)


def test_both_live_through_the_clocks_wrap():
    life = TwoCores("par4", DriveKind.DC, now_us=2**32 - 1_200_000)
    ready(life)
    for _ in range(40):
        lives_on(1)(life)
        streams(3, (0.2, 0.4, -0.3, 0.1), 1e-3, False, True, 0, 2)(life)
    assert life.now_us < 2**31
    assert_alike(life)


@pytest.mark.parametrize("reset", Reset)
@pytest.mark.parametrize(("spoilt", "source"), [("no", 1), ("bit", 2), ("blank", 0), ("none", 0), ("other robot", 2)])
def test_both_take_the_same_settings_from_memory(reset: Reset, spoilt: str, source: int):
    first = TwoCores("fivebar" if spoilt == "other robot" else "par4", DriveKind.DC)
    first.send(Set(setting_id("kp", 1), 99.0))
    image = bytearray(first.twin.image())
    assert bytes(image) == first.compiled.image()
    if spoilt == "bit":
        image[40] ^= 4
    memory = None if spoilt == "none" else b"\xff" * len(image) if spoilt == "blank" else bytes(image)
    life = TwoCores("par4", DriveKind.DC, reset, memory)
    for message in (Hello(), Get(setting_id("kp", 1))):
        life.send(message)
    life.run(8)
    assert_alike(life)
    identity = life.said[0].others[1][0]
    assert isinstance(identity, Identity) and (identity.settings, identity.reset) == (source, reset)


def assert_alike(life: TwoCores) -> None:
    """A moment at which one is a period ahead of the other, for rounding, is no difference; two in a row are."""
    real, twin = life.said
    assert len(real.telemetry) == len(twin.telemetry)
    before: list[str] = []
    for number, (a, b) in enumerate(zip(real.telemetry, twin.telemetry, strict=True)):
        now = differing(a, b, ROUNDING if not a.flags & Flag.MANUAL else MANUAL)
        assert not (now and before), f"report {number}: {now}\nC    {a}\ntwin {b}"
        before = now
    assert [number for _, number in real.others] == [number for _, number in twin.others]
    for (a, _), (b, _) in zip(real.others, twin.others, strict=True):
        if isinstance(a, Sample) and isinstance(b, Sample):
            assert (a.t_us, a.joint) == (b.t_us, b.joint) and close([a.position], [b.position], ROUNDING)
        elif isinstance(a, Ack) and isinstance(b, Ack):
            assert a.result == b.result and (a.value == b.value or a.value != a.value)
        else:
            assert a == b
    assert life.compiled.image() == life.twin.image()
    assert life.compiled.take_save_request() == life.twin.take_save_request()
    assert life.worst < 0.1
